#include "robot/core/pose/landmark_update.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "robot/core/pose/joseph.hpp"
#include "robot/core/pose/landmark_correction.hpp"

namespace priamos::robot {
namespace {

using Matrix = PoseState::Matrix;

/// Difference of two states with the heading wrapped.
PoseState::Vector Minus(const PoseState::Vector& a, const PoseState::Vector& b) {
  PoseState::Vector d = a - b;
  d(2) = WrapAngle(d(2));
  return d;
}

/// Estimate and measurement with their repeated parts widened so far that they count as independent.
struct Fusion {
  Matrix prior;
  Eigen::Matrix3d measurement;

  Gain<3> GainFor(const Derivative<3>& h) const {
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
Fusion BestFusion(const PoseState& prior, const LandmarkMeasurement& measurement, const Derivative<3>& h) {
  constexpr double kLeast = 1e-4, kGolden = 0.618, kExact = 1e-12;
  constexpr int kSteps = 20;
  if (prior.repeated.isZero(0) || measurement.own_share >= 1)
    return {prior.covariance, measurement.covariance};
  const auto spread = [&](double weight) {
    const Fusion fusion = Weighed(prior, measurement, weight);
    const Matrix after = Joseph<3>(fusion.GainFor(h), h, fusion.prior, fusion.measurement);
    return (after + kExact * Matrix::Identity(after.rows(), after.cols())).determinant();
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

/// Measured minus expected pose of the landmark in the base frame.
Eigen::Vector3d Residual(const Pose2& measured, const Pose2& expected) {
  return {measured.x - expected.x, measured.y - expected.y, WrapAngle(measured.yaw - expected.yaw)};
}

}  // namespace

MeasurementUpdate Updated(const PoseState& prior, const LandmarkMeasurement& measurement) {
  constexpr int kIterations = 6;
  const Pose2 start = Corrected(prior.pose(), CorrectionFrom(prior.pose(), measurement.base_from_landmark,
                                                             measurement.map_from_landmark));
  Derivative<3> h = Derivative<3>::Zero(3, prior.size());
  h.leftCols<3>() = PredictMeasurement(start, measurement.map_from_landmark).by_pose;
  const Fusion fusion = BestFusion(prior, measurement, h);
  PoseState::Vector at = prior.mean;
  at.head<3>() << start.x, start.y, start.yaw;

  Gain<3> gain;
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
      Joseph<3>(gain, h, prior.covariance - prior.repeated, measurement.own_share * measurement.covariance);
  update.state.covariance = Joseph<3>(gain, h, fusion.prior, fusion.measurement);
  update.state.repeated = update.state.covariance - own;
  return update;
}

}  // namespace priamos::robot
