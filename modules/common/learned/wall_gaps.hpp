#pragma once

#include <vector>

#include "common/learned/learned_walls.hpp"

namespace priamos {

/// An opening in a straight wall: from the end of one learned wall to the beginning of the next.
struct WallGap {
  int before = 0, behind = 0;  ///< the walls on both sides
  double x_m = 0, y_m = 0;     ///< map, its middle
  double yaw_deg = 0;          ///< map, along the wall
  double width_m = 0, sigma_width_m = 0;
};

/// Gaps of 0.5 to 3 m between walls that lie on one line and face the same way. They need not be told of by
/// a robot: they follow from the walls.
std::vector<WallGap> GapsOf(const LearnedWalls& walls);

/// A corner: two learned walls whose ends meet, nearer than half a metre to where their lines cross.
struct WallCorner {
  int first = 0, second = 0;
  double x_m = 0, y_m = 0;
  bool inner = true;  ///< whoever hears both walls stands in it
};
std::vector<WallCorner> CornersOf(const LearnedWalls& walls);

}  // namespace priamos
