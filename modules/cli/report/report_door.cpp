#include "cli/report/report_door.hpp"

#include <algorithm>

namespace priamos::cli {

std::optional<DoorPlan> BuiltDoor(const RunInfo& info) {
  if (!info.door) return std::nullopt;
  const auto built = std::find_if(info.world.doors.begin(), info.world.doors.end(),
                                  [&](const DoorPlan& door) { return door.id == info.door->id; });
  return built == info.world.doors.end() ? *info.door : *built;
}

RunRecord OnPlan(RunRecord record, const RunInfo& info) {
  if (!info.door) return record;
  const Pose2 plan_from_map = info.door->map_from_door() * BuiltDoor(info)->map_from_door().Inverse();
  for (world_truth_t& truth : record.truth) {
    const Pose2 pose = plan_from_map * Pose2{truth.x_m, truth.y_m, truth.yaw_rad};
    truth.x_m = pose.x;
    truth.y_m = pose.y;
    truth.yaw_rad = pose.yaw;
  }
  return record;
}

}  // namespace priamos::cli
