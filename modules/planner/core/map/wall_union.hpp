#pragma once

#include <Eigen/Core>

#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// How wall `b` lies to wall `a`, at the middle of what they have in common or between them.
struct WallOffset {
  double across_m = 0, yaw_rad = 0;  ///< of b against a, to the left of a
  double gap_m = 0;                  ///< between them along a; negative where they lie beside each other
  double distance = 0;               ///< Mahalanobis distance of their lines
};
WallOffset OffsetOf(const LearnedWall& a, const LearnedWall& b);

/// One wall in place of two, as long as both together. Its line is that of their covariance intersection.
LearnedWall UnionOf(const LearnedWall& a, const LearnedWall& b);

}  // namespace priamos::planner
