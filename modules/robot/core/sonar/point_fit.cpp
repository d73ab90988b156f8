#include "robot/core/sonar/point_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

using Eigen::Vector2d;

/// One step of Gauss and Newton.
struct Step {
  Vector2d change{0, 0};
  Eigen::Matrix2d cofactors = Eigen::Matrix2d::Identity();  ///< covariance for residuals of variance 1
  double squares = 0;                                       ///< of the residuals before it, in their sigmas
};

Step StepOf(const std::vector<PlacedEcho>& echoes, const Vector2d& place, const PointFitConfig& config) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Vector2d right(0, 0);
  Step step;
  for (const PlacedEcho& echo : echoes) {
    const Vector2d off = place - echo.odom_from_sonar.translation();
    const double distance_m = off.norm(), weight = 1 / config.SigmaOf(echo.range_m);
    const Vector2d by_place = weight * off / distance_m;
    const double residual = weight * (echo.range_m - distance_m);
    information += by_place * by_place.transpose();
    right += by_place * residual;
    step.squares += residual * residual;
  }
  step.cofactors = information.inverse();
  step.change = step.cofactors * right;
  return step;
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

/// The squares of the residuals, in their sigmas, that are left by the line which sees all echoes
/// perpendicularly.
double SquaresOfLine(const std::vector<PlacedEcho>& echoes, const Vector2d& place,
                     const PointFitConfig& config) {
  constexpr int kLineSteps = 3;
  Vector2d towards(0, 0);
  for (const PlacedEcho& echo : echoes) towards += place - echo.odom_from_sonar.translation();
  double angle = std::atan2(towards.y(), towards.x()), beyond_m = 0, squares = 0;
  for (int i = 0; i <= kLineSteps; ++i) {
    const Vector2d normal(std::cos(angle), std::sin(angle)), along(-normal.y(), normal.x());
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Vector2d right(0, 0);
    squares = 0;
    for (const PlacedEcho& echo : echoes) {
      const Vector2d off = place - echo.odom_from_sonar.translation();
      const double weight = 1 / config.SigmaOf(echo.range_m);
      const Vector2d by_line = weight * Vector2d(along.dot(off), 1);
      const double residual = weight * (echo.range_m - normal.dot(off) - beyond_m);
      information += by_line * by_line.transpose();
      right += by_line * residual;
      squares += residual * residual;
    }
    const Vector2d change = information.inverse() * right;
    angle += change.x();
    beyond_m += change.y();
  }
  return squares;
}

}  // namespace

void PointFitConfig::Describe(Archive& a) {
  a.Integer("least_echoes", least_echoes, {"-", 4, 1000, "echoes that are a place's"});
  a.Number("spread_deg", spread_deg, {"deg", 5, 180, "from directions that differ so much"});
  a.Number("off_axis_deg", off_axis_deg, {"deg", 3, 30, "so far off the axis of a sensor it is heard"});
  a.Number("most_rms", most_rms, {"-", 1, 10, "largest RMS of the residuals, in sigmas of a range"});
  a.Number("line_factor", line_factor,
           {"-", 1, 100, "a wall leaves so many times the squares of the residuals"});
  a.Number("range_sigma_m", range_sigma_m, {"m", 0.001, 0.1, "noise and rounding of a range, sigma"});
  a.Number("range_sigma_per_m", range_sigma_per_m, {"-", 0, 0.1, "growth of the noise with the range"});
}

bool MayComeFrom(const PlacedEcho& echo, const Vector2d& place, double gate_m, const PointFitConfig& config) {
  const Vector2d there = echo.odom_from_sonar.Inverse() * place;
  return std::abs(there.norm() - echo.range_m) < gate_m &&
         std::abs(std::atan2(there.y(), there.x())) < Radians(config.off_axis_deg);
}

std::optional<PointFit> FitPoint(const std::vector<PlacedEcho>& echoes, const Vector2d& near,
                                 const PointFitConfig& config) {
  constexpr int kSteps = 4;
  if (static_cast<int>(echoes.size()) < config.least_echoes) return std::nullopt;
  Vector2d place = near;
  Step step;
  for (int i = 0; i < kSteps; ++i) {
    step = StepOf(echoes, place, config);
    // Written so that NaN is refused.
    if (!(step.change.norm() < 1)) return std::nullopt;
    place += step.change;
  }
  const double variance = step.squares / static_cast<double>(echoes.size());
  if (variance > config.most_rms * config.most_rms) return std::nullopt;
  if (SpreadOf(echoes, place) < Radians(config.spread_deg)) return std::nullopt;
  // Written so that NaN is refused.
  if (!(SquaresOfLine(echoes, place, config) > config.line_factor * step.squares)) return std::nullopt;
  return PointFit{place, std::max(1.0, variance) * step.cofactors};
}

}  // namespace priamos::robot
