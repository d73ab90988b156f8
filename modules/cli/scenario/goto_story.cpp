#include "cli/scenario/goto_story.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/geometry.hpp"

namespace priamos::cli {

void GotoStory::GiveNext(Time now) {
  const ScenarioWaypoint& to = scenario().waypoints[waypoint_];
  mission_command_t command{};
  command.mission = mission_command_t::GOTO;
  command.x_m = to.x_m;
  command.y_m = to.y_m;
  command.yaw_rad = WrapAngle(Radians(to.yaw_deg));
  command.turn = true;
  Give(command);
  Report(now, fmt::format("order to the planner: drive to ({:.2f}, {:.2f})", to.x_m, to.y_m));
}

void GotoStory::Follow(Time now) {
  if (order().outcome() == OrderOutcome::kDone) return Arrive(now);
  if (order().outcome() != OrderOutcome::kOpen)
    End(now, false,
        fmt::format("waypoint {}: {}: {}", waypoint_ + 1, Text(order().outcome()), order().text()));
}

void GotoStory::Arrive(Time now) {
  const double off_m = DistanceFrom(scenario().waypoints[waypoint_]).value_or(0);
  worst_m_ = std::max(worst_m_, off_m);
  if (off_m > kNearWaypoint_m)
    return End(now, false, fmt::format("the base is {:.2f} m from waypoint {}", off_m, waypoint_ + 1));
  if (++waypoint_ < scenario().waypoints.size()) return GiveNext(now);
  End(now, true, fmt::format("at all {} waypoints, {:.2f} m off at most", waypoint_, worst_m_));
}

template StoryKind KindOf<GotoStory>();

}  // namespace priamos::cli
