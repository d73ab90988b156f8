#include "robot/core/pose/pose_state.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "robot/core/pose/landmark_correction.hpp"

namespace priamos::robot {
namespace {

using Matrix = PoseState::Matrix;
using Gain = Eigen::Matrix<double, PoseState::kSize, 3>;
using Derivative = Eigen::Matrix<double, 3, PoseState::kSize>;
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

/// The covariance after an update; this form stays symmetric and positive whatever was rounded.
Matrix Joseph(const Gain& gain, const Derivative& h, const Matrix& prior,
              const Eigen::Matrix3d& measurement) {
  const Matrix keep = Matrix::Identity() - gain * h;
  return keep * prior * keep.transpose() + gain * measurement * gain.transpose();
}

/// Estimate and measurement with their repeated parts widened so far that they count as independent.
struct Fusion {
  Matrix prior;
  Eigen::Matrix3d measurement;

  Gain GainFor(const Derivative& h) const {
    const Eigen::Matrix3d spread = h * prior * h.transpose() + measurement;
    return spread.ldlt().solve(h * prior).transpose();
  }
};

/// Fusion with a fixed `weight` of the estimate, in (0, 1); the measurement has the rest.
Fusion Weighed(const PoseState& prior, const LandmarkMeasurement& measurement, double weight) {
  return {prior.covariance + (1 / weight - 1) * prior.repeated,
          (measurement.own_share + (1 - measurement.own_share) / (1 - weight)) * measurement.covariance};
}

/// The weight after which the state is known best (golden section over the determinant, whose logarithm is
/// convex): of all of it, lest what the measurement does not show be widened for nothing.
Fusion BestFusion(const PoseState& prior, const LandmarkMeasurement& measurement, const Derivative& h) {
  constexpr double kLeast = 1e-4, kGolden = 0.618, kExact = 1e-12;
  constexpr int kSteps = 20;
  if (prior.repeated.isZero(0) || measurement.own_share >= 1)
    return {prior.covariance, measurement.covariance};
  const auto spread = [&](double weight) {
    const Fusion fusion = Weighed(prior, measurement, weight);
    const Matrix after = Joseph(fusion.GainFor(h), h, fusion.prior, fusion.measurement);
    return (after + kExact * Matrix::Identity()).determinant();
  };
  double low = kLeast, high = 1 - kLeast;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = spread(a), at_b = spread(b);
  for (int i = 0; i < kSteps; ++i) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = spread(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = spread(b);
    }
  }
  return Weighed(prior, measurement, (low + high) / 2);
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
  next.repeated = f * state.repeated * f.transpose();
  next.covariance.topLeftCorner<3, 3>() += by_increment * step.noise * by_increment.transpose();
  return next;
}

namespace {

/// Measured minus expected pose of the landmark in the base frame.
Eigen::Vector3d Residual(const Pose2& measured, const Pose2& expected) {
  return {measured.x - expected.x, measured.y - expected.y, WrapAngle(measured.yaw - expected.yaw)};
}

}  // namespace

MeasurementUpdate Updated(const PoseState& prior, const LandmarkMeasurement& measurement) {
  constexpr int kIterations = 6;
  const Pose2 start = Corrected(prior.pose(), CorrectionFrom(prior.pose(), measurement.base_from_landmark,
                                                             measurement.map_from_landmark));
  Derivative h = Derivative::Zero();
  h.leftCols<3>() = PredictMeasurement(start, measurement.map_from_landmark).by_pose;
  const Fusion fusion = BestFusion(prior, measurement, h);
  PoseState::Vector at = prior.mean;
  at.head<3>() << start.x, start.y, start.yaw;

  Gain gain;
  double squared_distance = 0;
  for (int i = 0; i < kIterations; ++i) {
    const ExpectedMeasurement expected =
        PredictMeasurement({at(0), at(1), at(2)}, measurement.map_from_landmark);
    h.leftCols<3>() = expected.by_pose;
    const Eigen::Vector3d residual = Residual(measurement.base_from_landmark, expected.base_from_landmark);
    const Eigen::Vector3d innovation = residual - h * Minus(prior.mean, at);
    gain = fusion.GainFor(h);
    const Eigen::Matrix3d spread = h * prior.covariance * h.transpose() + measurement.covariance;
    squared_distance = innovation.dot(spread.ldlt().solve(innovation));
    at = prior.mean + gain * innovation;
    at(2) = WrapAngle(at(2));
  }

  MeasurementUpdate update{prior, std::sqrt(std::max(0.0, squared_distance))};
  update.state.mean = at;
  const Matrix own =
      Joseph(gain, h, prior.covariance - prior.repeated, measurement.own_share * measurement.covariance);
  update.state.covariance = Joseph(gain, h, fusion.prior, fusion.measurement);
  update.state.repeated = update.state.covariance - own;
  return update;
}

}  // namespace priamos::robot
