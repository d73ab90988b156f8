#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
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

/// A closed convex outline: side i runs from corner i to corner i + 1, turning to the right (clockwise as
/// seen in the image). Four sides, opposite ones parallel: a parallelogram.
struct Polygon {
  std::vector<int> sides;    ///< segments
  std::vector<int> corners;  ///< indices in ContourGraph::corners
  bool is_parallelogram = false;
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

/// Geometrical relations between neighbouring edges, and the contours that follow from them (paper,
/// section 4.2). Building it takes time near-linear in the number of segments.
class ContourGraph {
 public:
  ContourGraph() = default;
  ContourGraph(const EdgeImage& edges, const ContourOptions& options);

  std::span<const Relation> relations() const { return relations_; }
  std::span<const Corner> corners() const { return corners_; }
  std::span<const Polygon> polygons() const { return polygons_; }

  /// The corners of a polygon in order [px].
  std::vector<Eigen::Vector2d> Outline(const Polygon& polygon) const;

 private:
  std::vector<Relation> relations_;
  std::vector<Corner> corners_;
  std::vector<Polygon> polygons_;
};

/// All pairs of segments that come within options.neighbour_px of each other and have a relation.
std::vector<Relation> FindRelations(const EdgeImage& edges, const ContourOptions& options);

/// All corners.
std::vector<Corner> FindCorners(const EdgeImage& edges, const ContourOptions& options);

/// Convex outlines made of `corners`, many of them in one place where sides are doubled; `corners_of` lists
/// them by 2 * segment + end.
std::vector<Polygon> FindPolygons(const EdgeImage& edges, std::span<const Corner> corners,
                                  std::span<const std::vector<int>> corners_of,
                                  const ContourOptions& options);

}  // namespace priamos::head
