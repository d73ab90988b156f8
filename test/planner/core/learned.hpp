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

/// Thing 3: a box of 0.60 x 0.40 m, 1.1 m high, with the middle of its front at (x, y), seen by three looks.
inline LearnedObject BoxAt(double x_m, double y_m, double yaw_deg) {
  LearnedObject box;
  box.id = 3;
  box.kind = "box";
  box.x_m = x_m;
  box.y_m = y_m;
  box.yaw_deg = yaw_deg;
  box.width_m = 0.6;
  box.depth_m = 0.4;
  box.top_m = 1.1;
  box.sigma_along_m = 0.03;
  box.sigma_across_m = 0.02;
  box.sigma_yaw_deg = 2;
  box.seen_s = 1000;
  box.looks = 3;
  return box;
}

}  // namespace priamos::planner
