#pragma once

#include <Eigen/Core>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "robot/core/base/odometry.hpp"

namespace priamos::robot {

/// Systematic errors of the odometry. Wheel radii, lever and roller loss do not change
/// during a run, so treating them as noise would claim too much after a long distance and too little after a
/// short one: they are estimated along with the pose. Values are standard deviations before the first fix.
struct OdometryBias {
  double forward = 0.004;         ///< scale of forward motion
  double sideways = 0.015;        ///< scale of sideways motion
  double yaw = 0.008;             ///< scale of turning
  double yaw_rad_per_m = 0.004;   ///< turn per metre forward: left and right wheels differ
  double drift_m_per_m = 0.0025;  ///< sideways distance per metre forward: front and rear wheels differ

  void Describe(Archive& a);
};

/// Pose of the base in the map with the constant errors of the odometry, and their joint covariance.
struct PoseState {
  static constexpr int kSize = 8;  ///< x, y, yaw, then the five of OdometryBias
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  Vector mean = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  Matrix repeated = Matrix::Zero();  ///< part of `covariance` from errors that later looks may repeat

  Pose2 pose() const { return {mean(0), mean(1), mean(2)}; }
  Eigen::Matrix3d pose_covariance() const { return covariance.topLeftCorner<3, 3>(); }
};

/// Velocity `twist` as measured by the wheels, cleared of the estimated constant errors.
Twist2 Unbiased(const PoseState& state, const Twist2& twist);

/// The state after `step`.
PoseState Propagated(const PoseState& state, const OdometryStep& step);

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
