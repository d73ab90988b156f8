#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// A place that echoes to all sides: an inner corner of a room, or an edge.
struct LearnedPoint {
  double x_m = 0, y_m = 0;  ///< map
  double sigma_m = 0;       ///< standard deviation of the place, in any direction at most
  double seen_s = 0;        ///< since 1970, when it was heard last

  void Describe(Archive& a);
  Eigen::Vector2d at() const { return {x_m, y_m}; }
};

/// As many are kept.
inline constexpr std::size_t kMostPoints = 1000;

/// Enters what a robot tells of a point, or replaces the nearest one, up to 20 cm away. Of more than
/// kMostPoints that goes which was not heard for longest.
void EnterPoint(const LearnedPoint& told, std::vector<LearnedPoint>& points);

}  // namespace priamos
