#include "planner/core/map/door_sides.hpp"

#include <utility>

namespace priamos::planner {

DoorPlan FromBehind(const DoorPlan& door) {
  DoorPlan behind = door;
  std::swap(behind.id, behind.behind_id);
  behind.yaw_deg = Degrees(WrapAngle(Radians(door.yaw_deg) + kPi));
  behind.frame_protrusion_m = 0;
  behind.leaf = "unknown";
  return behind;
}

std::vector<DoorPlan> DoorSides(const GroundPlan& plan) {
  std::vector<DoorPlan> sides;
  for (const DoorPlan& door : plan.doors) {
    sides.push_back(door);
    if (door.behind_id != 0) sides.push_back(FromBehind(door));
  }
  return sides;
}

}  // namespace priamos::planner
