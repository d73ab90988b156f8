#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// Geometrical relation of two neighbouring segments; several may hold.
struct Relation {
  int a = 0, b = 0;  ///< indices in EdgeImage::segments, a < b
  bool parallel = false, perpendicular = false, collinear = false, intersecting = false;
  double angle_rad = 0;    ///< between the lines, 0 to pi/2
  double distance_px = 0;  ///< if parallel: from the shorter one's middle to the other line
  bool same_sign = false;  ///< if parallel or collinear: the bright sides face the same way
};

/// The corner of two segments, extended to where they meet: it restores what the edge operator loses at
/// corners.
struct Corner {
  Eigen::Vector2d at;                  ///< position of the corner [px]
  Eigen::Matrix2d covariance;          ///< covariance of the position [px^2]
  std::array<int, 2> segments{};       ///< a, b
  std::array<int, 2> ends{};           ///< which end of each: 0 begin, 1 end
  std::array<double, 2> extension_px;  ///< length by which each was extended, negative if shortened
};

/// Thresholds for neighbours, corners, parallels and parallelograms; undistorted px and rad.
struct ContourOptions {
  double neighbour_px = 30;          ///< segments farther apart than that have no relation
  double max_extension_px = 15;      ///< longest extension of a segment to a corner
  double max_extension_share = 0.5;  ///< longest extension over the length of the segment
  double min_corner_rad = 0.2;       ///< flatter intersections are no corners
  double parallel_rad = 0.03;        ///< tolerance for perspective, beyond 3 sigma
  double perpendicular_rad = 0.05;
  double collinear_px = 0.8;    ///< distance of collinear segments, beyond 3 sigma
  int max_corners_per_end = 4;  ///< the nearest ones are kept
  int max_sides = 6;
  double perspective_rad = 0.12;  ///< largest angle between opposite sides of a parallelogram
};

/// All pairs of segments that come within options.neighbour_px of each other and have a relation.
std::vector<Relation> FindRelations(const EdgeImage& edges, const ContourOptions& options);

/// All corners.
std::vector<Corner> FindCorners(const EdgeImage& edges, const ContourOptions& options);

}  // namespace priamos::head
