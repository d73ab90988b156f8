#include "cli/scenario/corridor_story.hpp"

#include <fmt/format.h>

namespace priamos::cli {
namespace {

/// A corridor is followed somewhere between its walls, and ends a stopping distance before what closes it.
constexpr double kNearEnd_m = 1.2;

}  // namespace

void CorridorStory::Begin(Time now) {
  mission_command_t command{};
  command.mission = mission_command_t::CORRIDOR;
  Give(command);
  Report(now, "order to the planner: follow the corridor to its end");
}

void CorridorStory::Follow(Time now) {
  if (order().outcome() == OrderOutcome::kOpen) return;
  if (order().outcome() != OrderOutcome::kDone)
    return End(now, false, fmt::format("{}: {}", Text(order().outcome()), order().text()));
  const double off_m = DistanceFrom(scenario().waypoints.front()).value_or(0);
  if (off_m > kNearEnd_m)
    return End(now, false, fmt::format("the base is {:.2f} m from the corridor's end", off_m));
  End(now, true, order().text());
}

template StoryKind KindOf<CorridorStory>();

}  // namespace priamos::cli
