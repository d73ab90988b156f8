#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"

namespace priamos::robot {

/// How good a range is, and which series of ranges is a wall's.
struct WallFitConfig {
  int least_ranges = 12;         ///< in a series
  double most_bearing_deg = 16;  ///< angle between a sensor's axis and the normal of a wall it hears
  double range_sigma_m = 0.004;  ///< noise and rounding of a range
  double range_sigma_per_m = 0.002;
  double most_rms = 1.3;    ///< largest RMS of the residuals, in sigmas of a range: steps have more
  double most_bent = 2.5;   ///< largest curvature, in its sigmas: round things have more
  double sure_sigmas = 4;   ///< how far the curvature must be from that of an edge
  double drift_deg = 0.35;  ///< what the wheels lose of the heading within a series

  void Describe(Archive& a);
  double SigmaOf(double range_m) const { return range_sigma_m + range_sigma_per_m * range_m; }
};

/// A range that one sensor measured.
struct RangeAt {
  Pose2 base_from_sonar;  ///< frame of the base at another time, the same for a whole series
  double range_m = 0;
};

/// A straight wall beside the base: its normal's bearing in the base frame (towards the wall) and its
/// distance from the base's centre [rad, m], and their covariance.
struct WallSeen {
  double bearing_rad = 0;
  double distance_m = 0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
};

/// The wall that a series of ranges of one sensor shows, if it is one. A smooth wall answers with its
/// perpendicular distance as long as its normal lies in the beam: over the distance driven a straight line,
/// whose slope is the wall's angle. An edge or an inner corner at distance d answers with a curve of
/// curvature 1 / d: what may be that is no wall, and neither is what is bent or has steps.
std::optional<WallSeen> FitWall(const std::vector<RangeAt>& series, const WallFitConfig& config);

}  // namespace priamos::robot
