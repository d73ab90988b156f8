#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "head/core/landmark/edge_association.hpp"
#include "head/core/landmark/pose_solver.hpp"

namespace priamos::head {

/// Observations for the solver: every point of the matched segments within the predicted edge, undistorted.
/// With `coarse` only the two ends of each line, which is enough to approach.
std::vector<EdgeObservation> Observations(const LandmarkModel& model, const Association& association,
                                          std::span<const CameraView> views,
                                          const Eigen::Isometry3d& base_from_landmark, bool coarse);

}  // namespace priamos::head
