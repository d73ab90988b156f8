#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"
#include "robot/core/base/odometry.hpp"

namespace priamos::robot {

/// What the wheels say of the way between two fixes, and how far slip may make that wrong.
class WheelsBetween {
 public:
  /// The next step. Slip keeps its sign for a while: it adds up with what it has made already.
  void Add(const OdometryStep& step);

  /// From the base at the first fix to that at the second one.
  const Pose2& driven() const { return driven_; }
  double forward_m() const { return forward_m_; }
  /// Of the turn, by slip as configured [rad^2].
  double turn_variance() const { return covariance_(kTurn, kTurn); }
  /// Across the way, likewise [m^2].
  double across_variance() const { return covariance_(kAcross, kAcross); }
  /// Whether encoders were credible all the way.
  bool usable() const { return usable_; }

 private:
  /// The slips are per metre forward.
  enum Index { kAcross, kTurn, kTurnSlip, kAcrossSlip };

  Pose2 driven_;
  double forward_m_ = 0;
  bool usable_ = true, begun_ = false;
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
};

}  // namespace priamos::robot
