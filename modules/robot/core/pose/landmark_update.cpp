#include "robot/core/pose/landmark_update.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "robot/core/pose/landmark_correction.hpp"
#include "robot/core/pose/split_fusion.hpp"

namespace priamos::robot {
namespace {

using Matrix = PoseState::Matrix;

/// Difference of two states with the heading wrapped.
PoseState::Vector Minus(const PoseState::Vector& a, const PoseState::Vector& b) {
  PoseState::Vector d = a - b;
  d(2) = WrapAngle(d(2));
  return d;
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
  const auto fusion = BestFusion<3>(prior, measurement.covariance, measurement.own_share, h);
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
