#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// An upright edge of space: where vertical arrises, jambs and posts stand.
struct UprightEdge {
  Eigen::Vector2d at;              ///< place on the floor, base frame [m]
  Eigen::Matrix2d covariance;      ///< of that place [m^2]
  double bottom_m = 0, top_m = 0;  ///< heights above the floor between which it was seen
};

/// Which edges of space are upright, and which pieces are one edge.
struct UprightOptions {
  double lean = 0.035;         ///< tangent of the largest angle to the vertical, beyond 3 sigmas
  double min_height_m = 0.08;  ///< of a piece
  double max_sigma_m = 0.12;   ///< standard deviation of the place; what is known worse is left out
  double same_m = 0.01;        ///< pieces nearer than this, beyond 3 sigmas, are one edge
  double gap_m = 0.25;         ///< largest gap of height between two pieces of one edge
  double max_distance_m = 6;   ///< from the origin of base
};

/// Whether two may be one edge: one place within their errors, and no large gap of height between them.
bool AreOne(const UprightEdge& a, const UprightEdge& b, const UprightOptions& options);

/// The upright ones among the matched edges, pieces above each other put together.
std::vector<UprightEdge> FindUprights(std::span<const StereoMatch> matches, const UprightOptions& options);

}  // namespace priamos::head
