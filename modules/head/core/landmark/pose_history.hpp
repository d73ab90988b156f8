#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "head/core/landmark/landmark_fix.hpp"

namespace priamos::head {

/// The robot's estimate of its pose at one time.
struct PoseSample {
  Time time;
  Pose2 map_from_base;
  Twist2 twist;
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< covariance of map_from_base (x, y, yaw), map frame [m, rad]
};

/// The poses of the last seconds. The landmark is predicted for the time of the exposure, which has passed
/// when the picture arrives.
class PoseHistory {
 public:
  /// Adds a pose; those not newer than the newest one are ignored.
  void Add(const PoseSample& sample);

  /// The pose at `time`: between two samples, or up to `kReach` beyond the newest by its velocity; nullopt
  /// elsewhere.
  std::optional<PoseSample> At(Time time) const;

  static constexpr Duration kLength = std::chrono::seconds(3);
  static constexpr Duration kReach = std::chrono::milliseconds(300);

 private:
  std::deque<PoseSample> samples_;
};

/// Predicted pose of the landmark in the base frame; its covariance is that of the robot's pose, turned into
/// the base frame.
LandmarkPrediction Predict(const PoseSample& robot, const Pose2& map_from_landmark);

/// The same `ahead_s` later, for a robot that drives on as it does.
LandmarkPrediction PredictAhead(PoseSample robot, const Pose2& map_from_landmark, double ahead_s);

}  // namespace priamos::head
