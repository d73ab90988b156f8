#pragma once

#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// A learned wall around (x, y), known to 2 cm and half a degree.
inline LearnedWall WallAt(double x_m, double y_m, double yaw_deg, double length_m) {
  LearnedWall wall;
  wall.id = 1;
  wall.x_m = x_m;
  wall.y_m = y_m;
  wall.yaw_deg = yaw_deg;
  wall.length_m = length_m;
  wall.sigma_across_m = 0.02;
  wall.sigma_yaw_deg = 0.5;
  wall.sigma_end_m = 0.1;
  wall.seen_s = 1000;
  return wall;
}

}  // namespace priamos::planner
