#pragma once

#include <Eigen/Geometry>
#include <span>

#include "head/core/bodies/contour_evidence.hpp"
#include "head/core/bodies/polyhedron.hpp"
#include "head/core/edges/step_meter.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A pose at which a body's contour lies on steps of brightness.
struct ContourPose {
  Eigen::Isometry3d base_from_model = Eigen::Isometry3d::Identity();
  /// Of (x, y, z, roll, pitch, yaw) as in PoseJacobian [m, rad].
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  LandmarkModel seen;  ///< what is visible of the body there
};

/// Moves a body from `start` until its visible edges lie on the steps of brightness beside them, measured on
/// the images themselves, piece by piece (Harris 1990; Drummond and Cipolla 2002): also edges that are too
/// short, too blurred or too near to others to be linked take part. A step far from where the others have its
/// edge counts less, in the end nothing. `meters`: one for each view. nullopt if too few pieces are found to
/// tell a pose.
std::optional<ContourPose> FitContour(const Polyhedron& body, const Eigen::Isometry3d& start,
                                      std::span<const CameraView> views, std::span<const StepMeter> meters);

}  // namespace priamos::head
