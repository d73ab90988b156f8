#pragma once

#include <Eigen/Core>
#include <array>

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

/// Pose of the base in the map, the constant and the slowly changing errors of the odometry, the straight
/// walls that the sonars hear (none known before), and the joint covariance of all that.
struct PoseState {
  /// x, y, yaw, then the five of OdometryBias and the three of OdometryWander.
  static constexpr int kBias = 3, kWander = 8, kOwn = 11;
  static constexpr int kMostWalls = 4;
  static constexpr int kMost = kOwn + 2 * kMostWalls;  ///< each wall adds its angle and its distance
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;

  Vector mean = Vector::Zero(kOwn);
  Matrix covariance = Matrix::Zero(kOwn, kOwn);
  Matrix repeated =
      Matrix::Zero(kOwn, kOwn);  ///< part of `covariance` from errors that later looks may repeat
  /// Points of the map from which the distances of the walls count: where the base was when it found each.
  std::array<Eigen::Vector2d, kMostWalls> anchors{};

  int size() const { return static_cast<int>(mean.size()); }
  int walls() const { return (size() - kOwn) / 2; }
  Pose2 pose() const { return {mean(0), mean(1), mean(2)}; }
  Eigen::Matrix3d pose_covariance() const { return covariance.topLeftCorner<3, 3>(); }
};

/// Velocity `twist` as measured by the wheels, cleared of the estimated errors.
Twist2 Unbiased(const PoseState& state, const Twist2& twist);

/// The state after `step`.
PoseState Propagated(const PoseState& state, const OdometryStep& step);

}  // namespace priamos::robot
