#include "cli/scenario/explore_story.hpp"

#include <fmt/format.h>

namespace priamos::cli {

void ExploreStory::Begin(Time now) {
  mission_command_t command{};
  command.mission = mission_command_t::EXPLORE;
  Give(command);
  Report(now, "order to the planner: explore the floor");
}

void ExploreStory::Follow(Time now) {
  if (order().outcome() == OrderOutcome::kOpen) return;
  const bool done = order().outcome() == OrderOutcome::kDone;
  End(now, done, done ? order().text() : fmt::format("{}: {}", Text(order().outcome()), order().text()));
}

template StoryKind KindOf<ExploreStory>();

}  // namespace priamos::cli
