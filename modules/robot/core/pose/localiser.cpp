#include "robot/core/pose/localiser.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::robot {
namespace {

// More than any head sends; a flood of fixes with times in the future must not grow without bound.
constexpr std::size_t kMostWaiting = 16;

// Ranges of a wall that is not quite flat do not err independently of each other.
constexpr double kDependent = 1.5;

// The sensors of a cycle fire one group after the other; which one when is not told.
constexpr double kFiredBefore_s = 0.05;

constexpr double kLongestBack_s = 5;  // a velocity is not extrapolated back any further

}  // namespace

void LocaliserConfig::Describe(Archive& a) {
  a.Number("fix_wait_s", fix_wait_s, {"s", 0, 5, "how long a fix waits for odometry of its time"});
  a.Section("odometry", odometry, "dead reckoning of the four wheels");
  a.Section("walls", walls, "straight walls as the sonars show them");
  a.Section("estimator", estimator, "pose in the map");
}

Localiser::Localiser(const LocaliserConfig& config, const MecanumGeometry& geometry,
                     const Footprint& footprint)
    : config_(config),
      odometry_(config.odometry, geometry),
      estimator_(config.estimator),
      walls_(config.walls, footprint) {
  for (int i = 0; i < kSonars; ++i)
    base_from_sonar_[static_cast<std::size_t>(i)] = BaseFromSonar(i, {footprint.length_m, footprint.width_m});
}

bool Localiser::AddWheels(const WheelSample& sample, Time now) {
  const int accepted = odometry_.counters().accepted;
  if (auto step = odometry_.Add(sample, now)) {
    step->noise += std::exchange(slipped_, Eigen::Matrix3d::Zero());
    estimator_.Move(*step);
  }
  return odometry_.counters().accepted > accepted;
}

void Localiser::AddSlip(double position_m, double yaw_rad) {
  slipped_ +=
      Eigen::Vector3d(position_m * position_m, position_m * position_m, yaw_rad * yaw_rad).asDiagonal();
}

void Localiser::AddFix(const LandmarkFix& fix, Time now) {
  if (waiting_.size() < kMostWaiting) waiting_.push_back({fix, now});
}

Pose2 Localiser::Reset(const KnownPose& known) {
  waiting_.clear();
  return estimator_.Reset(known);
}

void Localiser::AddSonar(const SonarCycle& cycle) {
  const WallsHeard walls = walls_.Add(cycle, OdometryPoseAt(cycle.time));
  RingHeard heard{cycle.time, {}, walls.walls};
  const Twist2 twist = odometry_.twist();
  for (std::size_t i = 0; i < base_from_sonar_.size(); ++i) {
    if (!walls.sensors[i]) continue;
    const double range = cycle.range_m[i];
    const Pose2& at = base_from_sonar_[i];
    const Eigen::Vector2d speed(twist.vx - twist.wz * at.y, twist.vy + twist.wz * at.x);
    const double stale_m = at.rotation().col(0).dot(speed) * kFiredBefore_s;
    heard.ranges.push_back({at, range, std::hypot(kDependent * config_.walls.fit.SigmaOf(range), stale_m)});
  }
  estimator_.Hear(heard);
}

std::vector<Localiser::Answer> Localiser::Step(Time now) {
  std::vector<Answer> answers;
  std::vector<Waiting> still;
  for (const Waiting& waiting : waiting_) {
    FixResult result = estimator_.Apply(waiting.fix);
    const bool may_wait = now - waiting.received < FromSeconds(config_.fix_wait_s);
    if (result.verdict == FixVerdict::kTooNew && may_wait) {
      still.push_back(waiting);
    } else {
      answers.push_back({waiting.fix, result});
    }
  }
  waiting_ = std::move(still);
  return answers;
}

Pose2 Localiser::OdometryPoseAt(Time time) const {
  const auto newest = odometry_.time();
  const double since_s = newest ? Seconds(*newest - time) : 0;
  return Integrate(odometry_.pose(), odometry_.twist(), -std::clamp(since_s, 0.0, kLongestBack_s));
}

}  // namespace priamos::robot
