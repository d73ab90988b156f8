#include "robot/core/pose/pose_state.hpp"

#include <cmath>

namespace priamos::robot {
namespace {

using Matrix = PoseState::Matrix;
constexpr int kErrors = PoseState::kOwn - PoseState::kBias;
using ByErrors = Eigen::Matrix<double, 3, kErrors>;

enum ErrorIndex { kForward, kSideways, kYaw, kYawPerMetre, kDrift, kForwardNow, kYawNow, kDriftNow };

/// Derivative of a body increment with respect to the errors of the odometry.
ByErrors ByOdometry(const Eigen::Vector3d& measured) {
  ByErrors by = ByErrors::Zero();
  by(0, kForward) = by(0, kForwardNow) = measured.x();
  by(1, kSideways) = measured.y();
  by(1, kDrift) = by(1, kDriftNow) = measured.x();
  by(2, kYaw) = measured.z();
  by(2, kYawPerMetre) = by(2, kYawNow) = measured.x();
  return by;
}

Eigen::Vector3d Measured(const Twist2& twist, double seconds) {
  return Eigen::Vector3d(twist.vx, twist.vy, twist.wz) * seconds;
}

}  // namespace

void OdometryBias::Describe(Archive& a) {
  a.Number("forward", forward, {"-", 0, 0.2, "sigma of the scale of forward motion"});
  a.Number("sideways", sideways, {"-", 0, 0.2, "sigma of the scale of sideways motion"});
  a.Number("yaw", yaw, {"-", 0, 0.2, "sigma of the scale of turning"});
  a.Number("yaw_rad_per_m", yaw_rad_per_m, {"rad/m", 0, 0.2, "sigma of the turn per metre forward"});
  a.Number("drift_m_per_m", drift_m_per_m,
           {"m/m", 0, 0.2, "sigma of the sideways distance per metre forward"});
}

Twist2 Unbiased(const PoseState& state, const Twist2& twist) {
  const Eigen::Vector3d measured = Measured(twist, 1);
  const Eigen::Vector3d clear =
      measured + ByOdometry(measured) * state.mean.segment<kErrors>(PoseState::kBias);
  return {clear.x(), clear.y(), clear.z()};
}

PoseState Propagated(const PoseState& state, const OdometryStep& step) {
  const double dt = step.seconds();
  const Twist2 twist = Unbiased(state, step.twist);
  const Pose2 before = state.pose(), after = Integrate(before, twist, dt);

  PoseState next = state;
  next.mean.head<3>() << after.x, after.y, after.yaw;
  next.mean.segment<3>(PoseState::kWander) *= step.wander.kept;

  const double turn = twist.wz * dt;
  Eigen::Matrix3d by_increment = Eigen::Matrix3d::Identity();
  const Eigen::Matrix2d chord = Pose2{0, 0, before.yaw + turn / 2}.rotation();
  by_increment.topLeftCorner<2, 2>() = chord;
  by_increment.topRightCorner<2, 1>() = chord * Eigen::Vector2d(-twist.vy, twist.vx) * dt / 2;

  Matrix f = Matrix::Identity(state.size(), state.size());
  f(0, 2) = -(after.y - before.y);
  f(1, 2) = after.x - before.x;
  f.block<3, kErrors>(0, PoseState::kBias) = by_increment * ByOdometry(Measured(step.twist, dt));
  f.diagonal().segment<3>(PoseState::kWander).setConstant(step.wander.kept);
  next.covariance = f * state.covariance * f.transpose();
  next.repeated = f * state.repeated * f.transpose();
  next.covariance.topLeftCorner<3, 3>() += by_increment * step.noise * by_increment.transpose();
  next.covariance.diagonal().segment<3>(PoseState::kWander) += step.wander.variance;
  return next;
}

}  // namespace priamos::robot
