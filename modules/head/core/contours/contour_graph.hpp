#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/contours/contour_relations.hpp"
#include "head/core/contours/polygon_search.hpp"

namespace priamos::head {

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

}  // namespace priamos::head
