#include "head/core/contours/contour_graph.hpp"

#include "head/core/contours/repeated_outlines.hpp"

namespace priamos::head {

ContourGraph::ContourGraph(const EdgeImage& edges, const ContourOptions& options)
    : relations_(FindRelations(edges, options)), corners_(FindCorners(edges, options)) {
  std::vector<std::vector<int>> corners_of(2 * edges.segments.size());
  for (int i = 0; i < static_cast<int>(corners_.size()); ++i) {
    for (int k = 0; k < 2; ++k) corners_of[2 * corners_[i].segments[k] + corners_[i].ends[k]].push_back(i);
  }
  polygons_ = WithoutRepeated(FindPolygons(edges, corners_, corners_of, options), corners_);
}

std::vector<Eigen::Vector2d> ContourGraph::Outline(const Polygon& polygon) const {
  std::vector<Eigen::Vector2d> outline;
  for (const int c : polygon.corners) outline.push_back(corners_[c].at);
  return outline;
}

}  // namespace priamos::head
