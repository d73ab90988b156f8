#include "robot/core/pose/wheels_between.hpp"

#include "common/square.hpp"

namespace priamos::robot {

void WheelsBetween::Add(const OdometryStep& step) {
  const double forward = step.twist.vx * step.seconds(), kept = step.wander.kept;
  const Eigen::Vector2d added = step.wander.variance.tail<2>();  // of the turn, across
  usable_ = usable_ && step.known;
  driven_ = Integrate(driven_, step.twist, step.seconds());
  forward_m_ += forward;
  if (!begun_ && kept < 1) {
    covariance_.diagonal().tail<2>() = added / (1 - Square(kept));
    begun_ = true;
  }
  Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
  f(kAcross, kTurn) = f(kAcross, kAcrossSlip) = f(kTurn, kTurnSlip) = forward;
  f(kTurnSlip, kTurnSlip) = f(kAcrossSlip, kAcrossSlip) = kept;
  covariance_ = f * covariance_ * f.transpose();
  covariance_.diagonal() += Eigen::Vector4d(step.noise(1, 1), step.noise(2, 2), added(0), added(1));
}

}  // namespace priamos::robot
