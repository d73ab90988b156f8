#pragma once

#include <Eigen/Core>
#include <array>

#include "common/geometry.hpp"

namespace priamos {

/// A rectangle on the floor, turned as it likes: a footprint, a wall, the ground plan of a solid [m].
struct Rectangle {
  Pose2 map_from_centre;
  Eigen::Vector2d half_m{0, 0};  ///< half lengths along its own x and y axis

  Eigen::Vector2d ToLocal(const Eigen::Vector2d& in_map) const;
  /// Counter-clockwise.
  std::array<Eigen::Vector2d, 4> Corners() const;
  /// Its point that is nearest to another one, map frame: the other one itself when that lies inside.
  Eigen::Vector2d NearestTo(const Eigen::Vector2d& in_map) const;
};

/// Exact distance from a point [m]; 0 inside.
double Distance(const Rectangle& rectangle, const Eigen::Vector2d& in_map);

/// Exact distance between two rectangles [m]; 0 when they touch or overlap.
double Distance(const Rectangle& a, const Rectangle& b);

}  // namespace priamos
