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
  int id = 0;

  void Describe(Archive& a);
  Eigen::Vector2d at() const { return {x_m, y_m}; }
};

/// As many are kept.
inline constexpr std::size_t kMostPoints = 1000;
/// Points nearer to each other are one.
inline constexpr double kSamePoint_m = 0.2;

/// Enters a point that a robot reports: it replaces the nearest one that is the same by its place, and has
/// its number, or is one more. `told.id` is ignored. Of more than kMostPoints that goes which was not heard
/// for longest. Returns the point's number.
int EnterPoint(const LearnedPoint& told, std::vector<LearnedPoint>& points);

}  // namespace priamos
