#include "head/core/landmark/pose_history.hpp"

#include <algorithm>

namespace priamos::head {

void PoseHistory::Add(const PoseSample& sample) {
  if (!samples_.empty() && sample.time <= samples_.back().time) {
    // A clock that jumped back by more than the history is a restarted robot.
    if (samples_.front().time - sample.time < kLength) return;
    samples_.clear();
  }
  samples_.push_back(sample);
  while (samples_.back().time - samples_.front().time > kLength) samples_.pop_front();
}

std::optional<PoseSample> PoseHistory::At(Time time) const {
  if (samples_.empty() || time < samples_.front().time || time > samples_.back().time + kReach) {
    return std::nullopt;
  }
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), time,
                                      [](const PoseSample& s, Time t) { return s.time < t; });
  if (after != samples_.end() && after->time == time) return *after;
  // A fix between two samples makes the pose jump, so it is carried on from the sample before, not blended.
  PoseSample pose = *std::prev(after);
  pose.map_from_base = Integrate(pose.map_from_base, pose.twist, Seconds(time - pose.time));
  pose.time = time;
  return pose;
}

LandmarkPrediction Predict(const PoseSample& robot, const Pose2& map_from_landmark) {
  LandmarkPrediction prediction;
  prediction.base_from_landmark = robot.map_from_base.Inverse() * map_from_landmark;
  const Pose2& p = prediction.base_from_landmark;
  Eigen::Matrix3d j = Eigen::Matrix3d::Zero();
  j.topLeftCorner<2, 2>() = -robot.map_from_base.rotation().transpose();
  j.col(2) = Eigen::Vector3d(p.y, -p.x, -1);
  prediction.covariance = j * robot.covariance * j.transpose();
  return prediction;
}

LandmarkPrediction PredictAhead(PoseSample robot, const Pose2& map_from_landmark, double ahead_s) {
  robot.map_from_base = Integrate(robot.map_from_base, robot.twist, ahead_s);
  return Predict(robot, map_from_landmark);
}

}  // namespace priamos::head
