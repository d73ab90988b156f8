#pragma once

#include <vector>

#include "common/geometry.hpp"
#include "planner/core/map/obstacle_map.hpp"

namespace priamos::planner {

/// A narrow place between two obstacles: an opening in a wall, a corridor, what is left beside a cupboard.
struct NarrowPassage {
  Pose2 map_from_passage;  ///< its middle; x leads through it, y from one obstacle to the other
  double width_m = 0;      ///< between the obstacles
  double half_long_m = 0;  ///< as far along x to either side it is so narrow; 0: between two edges

  /// Whether a straight line leads from one of its sides to the other.
  bool IsCrossedBy(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Whether a body whose middle moves on that line, so long to either side of it, is in the passage
  /// anywhere.
  bool Holds(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_body_m) const;
};

/// The passages between any two of the obstacles that are `least_m` to `most_m` wide, and to whose middle
/// nothing is nearer than these two (the edges of a Gabriel graph: Gabriel and Sokal 1969). Of several at one
/// place the narrowest.
std::vector<NarrowPassage> NarrowPassagesOf(const ObstacleMap& obstacles, double least_m, double most_m);

}  // namespace priamos::planner
