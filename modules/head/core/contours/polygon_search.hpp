#pragma once

#include <span>
#include <vector>

#include "head/core/contours/contour_relations.hpp"

namespace priamos::head {

/// A closed convex outline: side i runs from corner i to corner i + 1, turning to the right (clockwise as
/// seen in the image). Four sides, opposite ones parallel: a parallelogram.
struct Polygon {
  std::vector<int> sides;    ///< segments
  std::vector<int> corners;  ///< indices in ContourGraph::corners
  bool is_parallelogram = false;
};

/// Convex outlines made of `corners`, many of them in one place where sides are doubled; `corners_of` lists
/// them by 2 * segment + end.
std::vector<Polygon> FindPolygons(const EdgeImage& edges, std::span<const Corner> corners,
                                  std::span<const std::vector<int>> corners_of,
                                  const ContourOptions& options);

}  // namespace priamos::head
