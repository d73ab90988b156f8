#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "robot/core/base/odometry.hpp"
#include "robot/core/sonar/placed_echo.hpp"
#include "robot/core/sonar/wall_fit.hpp"

namespace priamos::robot {

/// Which echoes are those of one wall, and how wrong their places are.
struct WallSegmentConfig {
  double most_m = 4;              ///< a longer wall is several segments: the odometry bends it
  double reach_m = 0.4;           ///< how far beyond its ends an echo still is of the wall
  double gate = 3;                ///< in sigmas of the range that is expected
  double most_rms = 2;            ///< RMS of the residuals, in sigmas of a range, at which it grows no more
  double sound_speed = 0.0023;    ///< sigma of the scale of all ranges, by the temperature
  double yaw_rad_per_m = 0.0037;  ///< sigma of the constant turn of the odometry per metre
  int most_echoes = 120;          ///< more are thinned out
  WallFitConfig range;            ///< noise of a range, and which series of ranges is a wall's

  void Describe(Archive& a);
};

/// A line in the frame of the odometry: n * (x - anchor) = distance_m, n at `angle_rad` towards the wall. The
/// covariance of (angle, distance) counts from the base at the newest echo: what the odometry lost since then
/// is not in it.
struct SegmentLine {
  double angle_rad = 0, distance_m = 0;
  Eigen::Vector2d anchor{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double rms_m = 0;  ///< of the residuals

  Eigen::Vector2d normal() const { return {std::cos(angle_rad), std::sin(angle_rad)}; }
  Eigen::Vector2d along() const { return {-std::sin(angle_rad), std::cos(angle_rad)}; }
};

/// Least squares of the line that all echoes (in order of time) see perpendicularly. The covariance is that
/// of the estimate under correlated errors: noise of each range, the random walk of the odometry's heading
/// and place between the echoes, its constant turn, and the speed of sound. nullopt when they do not tell a
/// line.
std::optional<SegmentLine> FitSegment(const std::vector<PlacedEcho>& echoes, double angle_rad,
                                      const WallSegmentConfig& config, const OdometryNoise& noise);

/// A straight piece of wall that grows by the echoes that fit it.
class WallSegment {
 public:
  /// `line`: of the echoes, as FitSegment gives it.
  WallSegment(const WallSegmentConfig& config, const OdometryNoise& noise, std::vector<PlacedEcho> echoes,
              const SegmentLine& line);

  /// Whether an echo is one of this wall, at its ends or between them.
  bool Takes(const PlacedEcho& echo) const;
  /// Whether the wall would be longer with an echo.
  bool EndsBefore(const PlacedEcho& echo) const;
  /// Takes the echoes of a cycle, each of which it Takes(), and fits the line anew. Returns false when the
  /// wall is straight no longer: then it stays as it was and grows no more.
  bool Add(const std::vector<PlacedEcho>& echoes);

  const SegmentLine& line() const { return line_; }
  /// Its ends in the frame of the odometry; whoever faces the wall has `from` to the right.
  const Eigen::Vector2d& from() const { return from_.at; }
  const Eigen::Vector2d& to() const { return to_.at; }
  double length_m() const { return (to_.at - from_.at).norm(); }
  /// How far an end may lie from there, the less sure of both. One sigma.
  double end_sigma_m() const { return std::max(from_.sigma_m, to_.sigma_m); }
  bool grows() const { return grows_; }
  const PlacedEcho& newest() const { return echoes_.back(); }

 private:
  struct End {
    Eigen::Vector2d heard{0, 0};  ///< foot of the outermost echo
    Eigen::Vector2d at{0, 0};
    double sigma_m = 0;
    bool grew = true;  ///< since it was found last
  };
  void Reach(const PlacedEcho& echo);
  void FindEnd(End& end, const Eigen::Vector2d& outward) const;
  void FindEnds();
  void Thin();

  WallSegmentConfig config_;
  OdometryNoise noise_;
  std::vector<PlacedEcho> echoes_;  ///< in order of time
  SegmentLine line_;
  End from_, to_;
  bool grows_ = true;
};

}  // namespace priamos::robot
