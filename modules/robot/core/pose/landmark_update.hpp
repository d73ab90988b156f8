#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "robot/core/pose/pose_state.hpp"

namespace priamos::robot {

/// One measurement of a landmark. Looks repeat the errors of its model and of the head's calibration, each
/// time from elsewhere and with other edges: that they are correlated is known, but not how.
struct LandmarkMeasurement {
  Pose2 base_from_landmark;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< covariance of (x, y, yaw) [m, rad]; positive definite
  Pose2 map_from_landmark;
  double own_share = 1;  ///< share of the covariance that is independent of other looks
};

/// Covariance-weighted update with one measurement of a landmark.
struct MeasurementUpdate {
  PoseState state;
  double distance = 0;  ///< Mahalanobis distance of the measurement from the estimate, 3 degrees of freedom
};

/// Iterated Kalman update (the maximum a posteriori estimate: Bell and Cathey, "The iterated Kalman filter
/// update as a Gauss-Newton method", IEEE Trans. Automatic Control 1993), started at the pose that equations
/// 8 and 9 give. Errors that looks share are treated by split covariance intersection (Julier and Uhlmann,
/// "General decentralized data fusion with covariance intersection", Handbook of Multisensor Data Fusion
/// 2001): the covariance is consistent whatever the correlation, two looks with the same error count no more
/// than one.
MeasurementUpdate Updated(const PoseState& prior, const LandmarkMeasurement& measurement);

}  // namespace priamos::robot
