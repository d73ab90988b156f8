#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// An edge of space in one look, as far as it tells what can be seen through.
struct SceneEdge {
  Eigen::Vector3d middle;      ///< base frame [m]
  Eigen::Matrix2d covariance;  ///< of its place on the floor [m^2]
  double length_px = 0;        ///< in the left image
};

/// Those of the matches that have a place in space.
std::vector<SceneEdge> SceneEdges(const CameraView& left, std::span<const StereoMatch> matches);

}  // namespace priamos::head
