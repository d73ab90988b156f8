#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot/core/sonar/wall_segment.hpp"

namespace priamos::robot {

/// When echoes are those of one place.
struct PointFitConfig {
  int least_echoes = 10;
  double spread_deg = 30;        ///< the place was heard from directions that differ so much at least
  double off_axis_deg = 15;      ///< so far off the axis of a sensor it is heard
  double most_rms = 2;           ///< largest RMS of the residuals, in sigmas of a range
  double line_factor = 4;        ///< a wall leaves so many times the squares of the residuals
  double range_sigma_m = 0.005;  ///< noise and rounding of a range, sigma; grows with the range
  double range_sigma_per_m = 0.003;

  void Describe(Archive& a);
  double SigmaOf(double range_m) const { return range_sigma_m + range_sigma_per_m * range_m; }
};

/// A place that echoes to all sides.
struct PointFit {
  Eigen::Vector2d at{0, 0};                                  ///< frame of the odometry, as of the newest echo
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of it [m^2]
};

/// Whether an echo may have come from a place, `gate_m` off in its range at most.
bool MayComeFrom(const PlacedEcho& echo, const Eigen::Vector2d& place, double gate_m,
                 const PointFitConfig& config);

/// The place that the echoes have their ranges to, by least squares from `near` on; nullopt when it is none:
/// a wall is heard from one direction only, and the ranges to a round thing do not meet. The covariance
/// counts the noise of ranges as large as the residuals show it.
std::optional<PointFit> FitPoint(const std::vector<PlacedEcho>& echoes, const Eigen::Vector2d& near,
                                 const PointFitConfig& config);

}  // namespace priamos::robot
