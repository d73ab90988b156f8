#include "head/core/scene/scene_edges.hpp"

namespace priamos::head {

std::vector<SceneEdge> SceneEdges(const CameraView& left, std::span<const StereoMatch> matches) {
  std::vector<SceneEdge> edges;
  for (const StereoMatch& match : matches) {
    if (!match.space) continue;
    const auto block = [&](Eigen::Index i, Eigen::Index j) {
      return match.space->covariance.block<2, 2>(3 * i, 3 * j);
    };
    edges.push_back({(match.space->from + match.space->to) / 2,
                     (block(0, 0) + block(0, 1) + block(1, 0) + block(1, 1)) / 4,
                     left.lines[match.left].length_px});
  }
  return edges;
}

}  // namespace priamos::head
