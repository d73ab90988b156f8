#include "robot/core/sonar/point_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

using Eigen::Vector2d;

/// One step of Gauss and Newton for two unknowns.
class Step {
 public:
  /// A residual of one sigma, and how it follows the unknowns.
  void Add(const Vector2d& by, double residual) {
    information_ += by * by.transpose();
    right_ += by * residual;
    squares_ += residual * residual;
  }
  Vector2d Change() const { return Cofactors() * right_; }
  /// Covariance for residuals of variance 1.
  Eigen::Matrix2d Cofactors() const { return information_.inverse(); }
  /// Of the residuals before the step.
  double squares() const { return squares_; }

 private:
  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
  Vector2d right_{0, 0};
  double squares_ = 0;
};

constexpr int kSteps = 4;
/// A fit that ends so far from where it began has lost its way.
constexpr double kFarOff_m = 1;

Step PointStep(const std::vector<PlacedEcho>& echoes, const Vector2d& place, const RangeNoise& noise) {
  Step step;
  for (const PlacedEcho& echo : echoes) {
    const Vector2d off = place - echo.odom_from_sonar.translation();
    const double weight = 1 / noise.SigmaOf(echo.range_m);
    step.Add(weight * off.normalized(), weight * (echo.range_m - off.norm()));
  }
  return step;
}

/// The line through `place + beyond_m * normal` which sees all echoes perpendicularly.
Step LineStep(const std::vector<PlacedEcho>& echoes, const Vector2d& place, double angle_rad, double beyond_m,
              const RangeNoise& noise) {
  const Vector2d normal(std::cos(angle_rad), std::sin(angle_rad)), along(-normal.y(), normal.x());
  Step step;
  for (const PlacedEcho& echo : echoes) {
    const Vector2d off = place - echo.odom_from_sonar.translation();
    const double weight = 1 / noise.SigmaOf(echo.range_m);
    step.Add(weight * Vector2d(along.dot(off), 1), weight * (echo.range_m - normal.dot(off) - beyond_m));
  }
  return step;
}

/// Squares of the residuals that the best place leaves, which becomes `place`.
double FindPlace(const std::vector<PlacedEcho>& echoes, Vector2d& place, const RangeNoise& noise) {
  for (int i = 0; i < kSteps; ++i) place += PointStep(echoes, place, noise).Change();
  return PointStep(echoes, place, noise).squares();
}

/// Squares of the residuals that the best line leaves.
double SquaresOfLine(const std::vector<PlacedEcho>& echoes, const Vector2d& place, const RangeNoise& noise) {
  Vector2d towards(0, 0);
  for (const PlacedEcho& echo : echoes) towards += place - echo.odom_from_sonar.translation();
  Vector2d line(std::atan2(towards.y(), towards.x()), 0);  // angle, beyond the place
  for (int i = 0; i < kSteps; ++i) line += LineStep(echoes, place, line.x(), line.y(), noise).Change();
  return LineStep(echoes, place, line.x(), line.y(), noise).squares();
}

/// As PointOverLine(), where the best place and the squares that it leaves are known.
double Surplus(const std::vector<PlacedEcho>& echoes, const Vector2d& place, double of_point,
               const RangeNoise& noise) {
  const double of_line = SquaresOfLine(echoes, place, noise);
  const double variance = std::max(1.0, std::min(of_point, of_line) / static_cast<double>(echoes.size()));
  return (of_line - of_point) / variance;
}

/// Of a place whose residuals have this variance, in sigmas of a range.
Eigen::Matrix2d CovarianceOf(const std::vector<PlacedEcho>& echoes, const Vector2d& place, double variance,
                             const PointFitConfig& config, const OdometryNoise& odometry) {
  const Eigen::Matrix2d cofactors = PointStep(echoes, place, config.noise).Cofactors();
  std::vector<EchoGain> gains;
  gains.reserve(echoes.size());
  for (const PlacedEcho& echo : echoes) {
    const Vector2d towards = (place - echo.odom_from_sonar.translation()).normalized();
    gains.push_back({cofactors * towards / std::pow(config.noise.SigmaOf(echo.range_m), 2), towards});
  }
  return variance * cofactors + SharedCovariance(echoes, gains, config.shared, odometry) +
         config.pulled_m * config.pulled_m * Eigen::Matrix2d::Identity();
}

/// The angle at a place within which it was heard [rad].
double SpreadOf(const std::vector<PlacedEcho>& echoes, const Vector2d& place) {
  const auto direction = [&](const PlacedEcho& echo) {
    const Vector2d off = echo.odom_from_sonar.translation() - place;
    return std::atan2(off.y(), off.x());
  };
  double low = 0, high = 0;
  for (const PlacedEcho& echo : echoes) {
    const double turned = WrapAngle(direction(echo) - direction(echoes.front()));
    low = std::min(low, turned);
    high = std::max(high, turned);
  }
  return high - low;
}

}  // namespace

void PointFitConfig::Describe(Archive& a) {
  a.Integer("least_echoes", least_echoes, {"-", 4, 1000, "echoes that are a place's"});
  a.Number("spread_deg", spread_deg, {"deg", 5, 180, "from directions that differ so much"});
  a.Number("off_axis_deg", off_axis_deg, {"deg", 3, 30, "so far off the axis of a sensor it is heard"});
  a.Number("most_rms", most_rms, {"-", 1, 10, "largest RMS of the residuals, in sigmas of a range"});
  a.Number("surplus", surplus, {"-", 0, 1000, "a wall explains them so much worse, in variances"});
  a.Number("range_sigma_m", noise.sigma_m, {"m", 0.001, 0.1, "noise and rounding of a range, sigma"});
  a.Number("pulled_m", pulled_m, {"m", 0, 0.2, "sigma of what pulls all its echoes alike"});
  a.Number("sound_speed", shared.sound_speed, {"-", 0, 0.1, "sigma of the scale of all ranges"});
  a.Number("yaw_rad_per_m", shared.yaw_rad_per_m,
           {"rad/m", 0, 0.2, "sigma of the odometry's turn per metre"});
  a.Number("range_sigma_per_m", noise.sigma_per_m, {"-", 0, 0.1, "growth of the noise with the range"});
}

bool MayComeFrom(const PlacedEcho& echo, const Vector2d& place, double gate_m, const PointFitConfig& config) {
  const Vector2d off = place - echo.odom_from_sonar.translation();
  // The distance first: it refuses most, and is cheap.
  if (!(std::abs(off.norm() - echo.range_m) < gate_m)) return false;
  const double bearing_rad = WrapAngle(std::atan2(off.y(), off.x()) - echo.odom_from_sonar.yaw);
  return std::abs(bearing_rad) < Radians(config.off_axis_deg);
}

double PointOverLine(const std::vector<PlacedEcho>& echoes, const Vector2d& near, const RangeNoise& noise) {
  Vector2d place = near;
  const double of_point = FindPlace(echoes, place, noise);
  return Surplus(echoes, place, of_point, noise);
}

std::optional<PointFit> FitPoint(const std::vector<PlacedEcho>& echoes, const Vector2d& near,
                                 const PointFitConfig& config, const OdometryNoise& odometry) {
  if (static_cast<int>(echoes.size()) < config.least_echoes) return std::nullopt;
  Vector2d place = near;
  const double squares = FindPlace(echoes, place, config.noise);
  const double variance = squares / static_cast<double>(echoes.size());
  // Written so that NaN is refused.
  if (!((place - near).norm() < kFarOff_m && variance <= config.most_rms * config.most_rms))
    return std::nullopt;
  if (SpreadOf(echoes, place) < Radians(config.spread_deg)) return std::nullopt;
  if (!(Surplus(echoes, place, squares, config.noise) > config.surplus)) return std::nullopt;
  return PointFit{place, CovarianceOf(echoes, place, std::max(1.0, variance), config, odometry)};
}

}  // namespace priamos::robot
