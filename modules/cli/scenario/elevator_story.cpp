#include "cli/scenario/elevator_story.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace priamos::cli {
namespace {

/// How long the cabin rides.
constexpr double kRide_s = 5;

mission_step_t Pass(int landmark_id) {
  mission_step_t step{};
  step.mission = mission_command_t::PASS_DOOR;
  step.landmark_id = static_cast<std::int16_t>(landmark_id);
  return step;
}

}  // namespace

void ElevatorStory::Begin(Time now) {
  if (scenario().waypoints.size() != 2)
    return End(now, false, "the scenario needs two waypoints, in the cabin and before it");
  mission_step_t ride{};
  ride.mission = mission_command_t::WAIT;
  ride.wait_s = kRide_s;
  mission_command_t command{};
  command.mission = mission_command_t::RUN;
  command.title = "elevator";
  command.rounds = 1;
  command.steps = {Pass(scenario().landmark_id), ride, Pass(scenario().landmark_id)};
  command.n_steps = static_cast<std::int8_t>(command.steps.size());
  Give(command);
}

/// The ride is step 2: by its end the base stands in the cabin, and has not begun to leave it.
void ElevatorStory::Follow(Time now) {
  const bool rode =
      std::ranges::any_of(order().steps(), [](const mission_result_t& result) { return result.step == 2; });
  if (rode && !inside_) {
    if (!IsAt(0, now)) return;
    inside_ = true;
  }
  if (order().outcome() == OrderOutcome::kOpen) return;
  if (order().outcome() != OrderOutcome::kDone)
    return End(now, false, fmt::format("{}: {}", Text(order().outcome()), order().text()));
  if (IsAt(1, now)) End(now, true, fmt::format("into the cabin, {:.0f} s in it, and out", kRide_s));
}

bool ElevatorStory::IsAt(std::size_t waypoint, Time now) {
  const double off_m = DistanceFrom(scenario().waypoints[waypoint]).value_or(0);
  if (off_m <= kNearWaypoint_m) return true;
  End(now, false, fmt::format("the base is {:.2f} m from waypoint {}", off_m, waypoint + 1));
  return false;
}

template StoryKind KindOf<ElevatorStory>();

}  // namespace priamos::cli
