#include "head/core/landmark/edge_observations.hpp"

#include <algorithm>

#include "head/core/camera/projection.hpp"

namespace priamos::head {

std::vector<EdgeObservation> Observations(const LandmarkModel& model, const Association& association,
                                          std::span<const CameraView> views,
                                          const Eigen::Isometry3d& base_from_landmark, bool coarse) {
  constexpr double kBeyond_px = 3;
  std::vector<EdgeObservation> observations;
  for (const EdgeMatch& match : association.matches) {
    if (!match.is_measured) continue;
    const CameraView& view = views[match.camera];
    const LandmarkEdge& edge = model.edges[match.edge];
    const auto predicted =
        ProjectEdge(*view.camera, view.size, base_from_landmark * edge.from, base_from_landmark * edge.to);
    if (!predicted) continue;
    const double length = predicted->length_px();
    const Eigen::Vector2d direction = predicted->direction();
    for (const int index : match.lines) {
      const ViewLine& line = view.lines[index];
      const EdgeSegment& segment = view.edges->segments[line.segment];
      if (coarse) {
        const double s = direction.dot(line.p - predicted->p), t = direction.dot(line.q - predicted->p);
        for (const double at : {std::clamp(s, 0.0, length), std::clamp(t, 0.0, length)}) {
          const double f = (at - s) / (t - s);
          observations.push_back({match.edge, match.camera, line.p + f * (line.q - line.p), 0.3});
        }
        continue;
      }
      for (int i = 0; i < segment.n_points; ++i) {
        const EdgePoint& point = view.edges->points[segment.first_point + i];
        const Eigen::Vector2d& at = view.points[segment.first_point + i];
        const double along = direction.dot(at - predicted->p);
        if (along < -kBeyond_px || along > length + kBeyond_px) continue;
        observations.push_back({match.edge, match.camera, at, point.sigma_normal_px});
      }
    }
  }
  return observations;
}

}  // namespace priamos::head
