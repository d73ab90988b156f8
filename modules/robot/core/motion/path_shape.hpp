#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/braking_law.hpp"
#include "common/robot/leeway.hpp"

namespace priamos::robot {

/// Poses for the base, map frame: straight lines between them, heading interpolated.
struct Path {
  int id = 0;
  double speed_m_s = 0;
  std::vector<Pose2> points{};   ///< from the next one to the goal; none: brake and hold
  std::vector<Leeway> leeway{};  ///< of the line to each point; missing ones are 0
  bool centre = false;           ///< keep to the middle of a corridor; one point, ahead in its direction
  int estop_changes = 0;         ///< Authority::estop_changes() as who ordered the path knew it
};

/// Whether two orders are to drive the same path: number, speed and points.
bool SameCourse(const Path& a, const Path& b);
/// Length [m] of the straight lines from `start` over all points of a path.
double LengthFrom(const Pose2& start, const Path& path);

/// How a path is rounded, and how fast its parts may be driven.
struct PathShapeConfig {
  double corner_deviation_m = 0.05;   ///< how far a rounded corner may pass beside the point
  double corner_deviation_deg = 3.0;  ///< largest deviation of the heading in a rounded corner
  double corner_acceleration_m_s2 = 0.4;
  double corner_turn_acceleration_rad_s2 = 0.6;
  double max_speed_m_s = 0.6;
  double max_turn_rad_s = 0.5;
  double braking_m_s2 = 0.4;  ///< before corners and the last point

  void Describe(Archive& a);
};

/// A path as a curve over its arc length s [m]: linear segments joined by parabolic blends (Taylor, "Planning
/// and execution of straight line manipulator trajectories", IBM J. Res. Dev. 1979), so that at constant
/// speed the acceleration in a corner is constant, too. A turn on the spot takes distance as well: kTurnLever
/// metres per radian. Between the points the curve leaves the straight lines only at corners, by the allowed
/// deviation.
class PathShape {
 public:
  static constexpr double kTurnLever = 0.6;  ///< [m/rad] about the reach of the base's corners

  /// A point of the path at the arc length s [m], map frame.
  struct Point {
    Pose2 pose;
    Eigen::Vector2d direction{0, 0};  ///< d position / d s; shorter than 1 while turning or in a corner
    double turn = 0;                  ///< d yaw / d s [rad/m]

    /// Unit vector to the left of the path; 0 while turning on the spot.
    Eigen::Vector2d left() const;
  };

  /// The curve from `start` through path.points.
  PathShape(const PathShapeConfig& config, const Pose2& start, const Path& path);

  /// Changes the fastest speeds of the curve; its form stays.
  void LimitSpeeds(const PathShapeConfig& config);

  double length() const { return length_; }
  /// Point at the arc length s [m], which is clamped to 0..length().
  Point At(double s) const;
  /// Fastest ds/dt at s from which every later limit, and the stop at the end, is still reached by braking.
  double SpeedAt(double s) const;
  /// How far the path may be left at s.
  Leeway LeewayAt(double s) const;
  /// Distance of the base centre from s to the end [m], turns on the spot not counted.
  double RemainingDistance(double s) const;
  /// The s near `guess` where the curve is closest to `pose`, position and heading together. Searches
  /// downhill, so a path that crosses itself is not cut short.
  double Project(const Pose2& pose, double guess) const;

 private:
  struct Segment {
    double begin = 0, length = 0;  ///< [m] of s
    Eigen::Vector2d from{0, 0}, direction{0, 0};
    double yaw = 0, turn = 0;  ///< yaw at begin, not wrapped
    double blend = 0;          ///< half length of the blend into the next segment [m of s]
    Leeway leeway{};
  };
  struct SpeedLimit {
    double begin = 0, end = 0, speed = 0;
  };

  void AddSegment(const Pose2& to, const Leeway& leeway);
  void Blend(const PathShapeConfig& config);
  Point OnSegment(const Segment& segment, double s) const;
  Point OnBlend(const Segment& before, const Segment& after, double s) const;
  std::size_t SegmentAt(double s) const;

  BrakingLaw braking_;
  double path_speed_;  ///< that of the order [m/s]
  Pose2 end_;          ///< last pose taken in, yaw not wrapped
  std::vector<Segment> segments_;
  std::vector<SpeedLimit> limits_;
  double length_ = 0;
};

}  // namespace priamos::robot
