#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot/core/sonar/echo_errors.hpp"
#include "robot/core/sonar/placed_echo.hpp"

namespace priamos::robot {

/// Noise and rounding of a range, sigma; it grows with the range.
struct RangeNoise {
  double sigma_m = 0.005, sigma_per_m = 0.003;

  double SigmaOf(double range_m) const { return sigma_m + sigma_per_m * range_m; }
};

/// When echoes are those of one place.
struct PointFitConfig {
  int least_echoes = 20;
  double spread_deg = 30;    ///< the place was heard from directions that differ so much at least
  double off_axis_deg = 12;  ///< so far off the axis of a sensor it is heard
  double most_rms = 1.4;     ///< largest RMS of the residuals, in sigmas of a range
  double surplus = 60;       ///< a wall explains them so much worse, see PointOverLine()
  RangeNoise noise{};
  SharedErrors shared{};
  /// What pulls all its echoes alike, sigma in any direction: those of the wall beside an edge, or of the
  /// other edge of a thin wall.
  double pulled_m = 0.02;

  void Describe(Archive& a);
};

/// A place that echoes to all sides.
struct PointFit {
  Eigen::Vector2d at{0, 0};                                  ///< frame of the odometry, as of the newest echo
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of it [m^2]
};

/// Whether an echo may have come from a place, `gate_m` off in its range at most.
bool MayComeFrom(const PlacedEcho& echo, const Eigen::Vector2d& place, double gate_m,
                 const PointFitConfig& config);

/// How much better a place near `near` explains echoes than a straight wall before which it lies does:
/// difference of the sums of squared residuals, in variances of a range as the better of both shows it.
/// Negative: the wall does. NaN when echoes tell neither.
double PointOverLine(const std::vector<PlacedEcho>& echoes, const Eigen::Vector2d& near,
                     const RangeNoise& noise);

/// The place that the echoes have their ranges to, by least squares from `near` on; nullopt when it is none:
/// a wall is heard from one direction only, and the ranges to a round thing do not meet. The covariance
/// counts the noise of ranges as large as the residuals show it, and the errors that the echoes share: what
/// was heard from one side only is known badly across that.
std::optional<PointFit> FitPoint(const std::vector<PlacedEcho>& echoes, const Eigen::Vector2d& near,
                                 const PointFitConfig& config, const OdometryNoise& odometry);

}  // namespace priamos::robot
