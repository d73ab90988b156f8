#include "robot/core/pose_state.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "robot/core/landmark_correction.hpp"

namespace priamos::robot {
namespace {

using Matrix = PoseState::Matrix;
using Gain = Eigen::Matrix<double, PoseState::kSize, 3>;
using Bias = Eigen::Matrix<double, 3, 5>;

enum BiasIndex { kForward, kSideways, kYaw, kYawPerMetre, kDrift };

/// Derivative of a body increment with respect to the constant errors.
Bias ByBias(const Eigen::Vector3d& measured) {
  Bias by = Bias::Zero();
  by(0, kForward) = measured.x();
  by(1, kSideways) = measured.y();
  by(1, kDrift) = measured.x();
  by(2, kYaw) = measured.z();
  by(2, kYawPerMetre) = measured.x();
  return by;
}

Eigen::Vector3d Measured(const Twist2& twist, double seconds) {
  return Eigen::Vector3d(twist.vx, twist.vy, twist.wz) * seconds;
}

/// Difference of two states with the heading wrapped.
PoseState::Vector Minus(const PoseState::Vector& a, const PoseState::Vector& b) {
  PoseState::Vector d = a - b;
  d(2) = WrapAngle(d(2));
  return d;
}

}  // namespace

void OdometryBias::Describe(Archive& a) {
  a.Number("forward", forward, {"-", 0, 0.2, "sigma of the scale of forward motion"});
  a.Number("sideways", sideways, {"-", 0, 0.2, "sigma of the scale of sideways motion"});
  a.Number("yaw", yaw, {"-", 0, 0.2, "sigma of the scale of turning"});
  a.Number("yaw_rad_per_m", yaw_rad_per_m, {"rad/m", 0, 0.2, "sigma of the turn per metre forward"});
  a.Number("drift_m_per_m", drift_m_per_m, {"m/m", 0, 0.2, "sigma of the sideways way per metre forward"});
}

Twist2 Unbiased(const PoseState& state, const Twist2& twist) {
  const Eigen::Vector3d measured = Measured(twist, 1);
  const Eigen::Vector3d clear = measured + ByBias(measured) * state.mean.tail<5>();
  return {clear.x(), clear.y(), clear.z()};
}

PoseState Propagated(const PoseState& state, const OdometryStep& step) {
  const double dt = step.seconds();
  const Twist2 twist = Unbiased(state, step.twist);
  const Pose2 before = state.pose(), after = Integrate(before, twist, dt);

  PoseState next = state;
  next.mean.head<3>() << after.x, after.y, after.yaw;

  const double turn = twist.wz * dt;
  Eigen::Matrix3d by_increment = Eigen::Matrix3d::Identity();
  const Eigen::Matrix2d chord = Pose2{0, 0, before.yaw + turn / 2}.rotation();
  by_increment.topLeftCorner<2, 2>() = chord;
  by_increment.topRightCorner<2, 1>() = chord * Eigen::Vector2d(-twist.vy, twist.vx) * dt / 2;

  Matrix f = Matrix::Identity();
  f(0, 2) = -(after.y - before.y);
  f(1, 2) = after.x - before.x;
  f.topRightCorner<3, 5>() = by_increment * ByBias(Measured(step.twist, dt));
  next.covariance = f * state.covariance * f.transpose();
  next.covariance.topLeftCorner<3, 3>() += by_increment * step.noise * by_increment.transpose();
  return next;
}

SightUpdate UpdatedBySight(const PoseState& prior, const Pose2& base_from_landmark,
                           const Eigen::Matrix3d& covariance, const Pose2& map_from_landmark) {
  constexpr int kIterations = 6;
  const Pose2 start =
      Corrected(prior.pose(), CorrectionFrom(prior.pose(), base_from_landmark, map_from_landmark));
  PoseState::Vector at = prior.mean;
  at.head<3>() << start.x, start.y, start.yaw;

  Gain gain;
  Eigen::Matrix<double, 3, PoseState::kSize> h = Eigen::Matrix<double, 3, PoseState::kSize>::Zero();
  double squared_distance = 0;
  for (int i = 0; i < kIterations; ++i) {
    const ExpectedSight expected = ExpectSight({at(0), at(1), at(2)}, map_from_landmark);
    h.leftCols<3>() = expected.by_pose;
    const Eigen::Vector3d residual(base_from_landmark.x - expected.base_from_landmark.x,
                                   base_from_landmark.y - expected.base_from_landmark.y,
                                   WrapAngle(base_from_landmark.yaw - expected.base_from_landmark.yaw));
    const Eigen::Vector3d innovation = residual - h * Minus(prior.mean, at);
    const auto spread = Eigen::Matrix3d(h * prior.covariance * h.transpose() + covariance).ldlt();
    gain = spread.solve(h * prior.covariance).transpose();
    squared_distance = innovation.dot(spread.solve(innovation));
    at = prior.mean + gain * innovation;
    at(2) = WrapAngle(at(2));
  }

  SightUpdate update{prior, std::sqrt(std::max(0.0, squared_distance))};
  update.state.mean = at;
  // Joseph's form stays symmetric and positive whatever was rounded.
  const Matrix keep = Matrix::Identity() - gain * h;
  update.state.covariance = keep * prior.covariance * keep.transpose() + gain * covariance * gain.transpose();
  return update;
}

}  // namespace priamos::robot
