#pragma once

#include <cmath>

#include "common/config.hpp"
#include "common/ground_plan.hpp"

namespace priamos::planner {

inline GroundPlan ShippedPlan() {
  return LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml");
}

/// A landing and a cabin of 1.10 m by 1.40 m.
inline GroundPlan ElevatorPlan() {
  return LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/elevator.toml");
}

/// The shipped plan moved as a whole.
inline GroundPlan Moved(GroundPlan plan, const Pose2& new_from_map) {
  for (WallPlan& wall : plan.walls) {
    const Eigen::Vector2d from = new_from_map * wall.from(), to = new_from_map * wall.to();
    wall.from_m = {from.x(), from.y()};
    wall.to_m = {to.x(), to.y()};
  }
  for (DoorPlan& door : plan.doors) {
    const Pose2 moved = new_from_map * door.map_from_door();
    door.x_m = moved.x;
    door.y_m = moved.y;
    door.yaw_deg = Degrees(moved.yaw);
  }
  return plan;
}

}  // namespace priamos::planner
