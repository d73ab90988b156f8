#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "robot/core/sonar/segment_finder.hpp"
#include "test/robot/support/simulated_base.hpp"
#include "test/robot/support/simulated_sonars.hpp"

namespace priamos::robot {

/// A base with odometry and sonars that drives blindly, and the segments that are found on the way.
class CorridorDrive {
 public:
  CorridorDrive(std::uint64_t seed, const Pose2& truth, std::vector<Surface> surfaces,
                const SegmentFinderConfig& config = {})
      : base_(seed, truth),
        sonars_(seed, std::move(surfaces)),
        sound_(1 + Rng::Stream(seed, "sound speed").Uniform(-0.004, 0.004)),
        odometry_(OdometryConfig{}, MecanumGeometry{}),
        dut_(config, OdometryNoise{}, Footprint{}) {
    sonars_.FireInGroups(config.groups);
  }

  SegmentFinder::OfPoint of_point{};  ///< which echoes can be of a known point

  void Drive(const Twist2& twist, double seconds) {
    for (int i = 0; i < seconds * 50; ++i) {
      base_.Command(ToWheelSpeeds({}, twist), base_.now());
      base_.Advance(std::chrono::milliseconds(20));
      odometry_.Add(base_.Read(), base_.now());
      if (++tick_ % 5 != 0) continue;
      for (const FoundSegment* found : dut_.Add(Listen(), odometry_.pose(), of_point)) {
        found_.insert_or_assign(found->number, *found);
        true_base_.insert_or_assign(found->number, base_.truth());
      }
    }
  }

  /// Every segment as it was last, by its number.
  const std::map<int, FoundSegment>& found() const { return found_; }
  /// Where the base truly was when the segment was heard last.
  const Pose2& TrueBaseOf(int number) const { return true_base_.at(number); }
  const Pose2& truth() const { return base_.truth(); }
  SimulatedSonars& sonars() { return sonars_; }
  SegmentFinder& dut() { return dut_; }

  /// Error of a segment against the line of a true wall, seen from the base when it was heard last: of the
  /// direction and of the middle across it [rad, m].
  Eigen::Vector2d ErrorOf(const FoundSegment& found, const Surface& wall) const {
    const Pose2 map_from_odom = TrueBaseOf(found.number) * found.wall.newest().odom_from_base.Inverse();
    const Eigen::Vector2d middle = map_from_odom * ((found.wall.from() + found.wall.to()) / 2);
    const Eigen::Vector2d along = (wall.to - wall.from).normalized();
    const double true_angle = std::atan2(along.y(), along.x()) - kPi / 2;
    double angle = WrapAngle(found.wall.line().angle_rad + map_from_odom.yaw - true_angle);
    double side = 1;
    if (std::abs(angle) > kPi / 2) {
      angle = WrapAngle(angle + kPi);
      side = -1;
    }
    const Eigen::Vector2d normal = side * Eigen::Vector2d(along.y(), -along.x());
    return {angle, normal.dot(middle - wall.from)};
  }
  /// The covariance of that error.
  static Eigen::Matrix2d CovarianceOf(const FoundSegment& found) {
    const SegmentLine& line = found.wall.line();
    const double along_m = line.along().dot((found.wall.from() + found.wall.to()) / 2 - line.anchor);
    Eigen::Matrix2d by_line;
    by_line << 1, 0, -along_m, 1;
    return by_line * line.covariance * by_line.transpose();
  }

 private:
  /// The ring's resolution is 1 cm, and the temperature is not known.
  SonarCycle Listen() {
    constexpr double kResolution_m = 0.01;
    SonarCycle cycle = sonars_.Listen(base_.now(), base_.truth());
    for (double& range_m : cycle.range_m)
      if (range_m > 0) range_m = std::round(range_m * sound_ / kResolution_m) * kResolution_m;
    return cycle;
  }

  SimulatedBase base_;
  SimulatedSonars sonars_;
  double sound_;
  Odometry odometry_;
  SegmentFinder dut_;
  std::map<int, FoundSegment> found_;
  std::map<int, Pose2> true_base_;
  int tick_ = 0;
};

}  // namespace priamos::robot
