#include "robot/core/sonar/wall_segment.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "robot/core/sonar/echo_errors.hpp"
#include "robot/core/sonar/wall_end.hpp"

namespace priamos::robot {
namespace {

Eigen::Matrix2d Outer(const Eigen::Vector2d& v) {
  return v * v.transpose();
}

/// The echoes seen from a line through their middle.
struct Design {
  Eigen::VectorXd along_m, range_m;  ///< of the sensor, from the anchor; measured
  Eigen::Matrix2d cofactors;         ///< covariance of (angle, distance) for ranges of variance 1
};

Eigen::Vector2d MiddleOf(const std::vector<PlacedEcho>& echoes) {
  Eigen::Vector2d sum(0, 0);
  for (const PlacedEcho& echo : echoes) sum += echo.odom_from_sonar.translation();
  return sum / static_cast<double>(echoes.size());
}

/// One step of Gauss and Newton; the design at the angle before the step.
Design Improve(const std::vector<PlacedEcho>& echoes, SegmentLine& line) {
  const auto count = static_cast<Eigen::Index>(echoes.size());
  Design design{Eigen::VectorXd(count), Eigen::VectorXd(count), {}};
  const Eigen::Vector2d normal = line.normal(), along = line.along();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right(0, 0);
  double squares = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const PlacedEcho& echo = echoes[static_cast<std::size_t>(k)];
    const Eigen::Vector2d at = echo.odom_from_sonar.translation() - line.anchor;
    design.along_m(k) = along.dot(at);
    design.range_m(k) = echo.range_m;
    const double residual = echo.range_m - (line.distance_m - normal.dot(at));
    const Eigen::Vector2d by_line(-design.along_m(k), 1);
    information += Outer(by_line);
    right += by_line * residual;
    squares += residual * residual;
  }
  design.cofactors = information.inverse();
  const Eigen::Vector2d change = design.cofactors * right;
  line.angle_rad = WrapAngle(line.angle_rad + change(0));
  line.distance_m += change(1);
  line.rms_m = std::sqrt(squares / static_cast<double>(count));
  return design;
}

/// Covariance of a least squares estimate whose ranges do not err independently.
Eigen::Matrix2d CovarianceOf(const std::vector<PlacedEcho>& echoes, const Design& design,
                             const SegmentLine& line, const WallSegmentConfig& config,
                             const OdometryNoise& noise) {
  const double sigma_m = config.range.SigmaOf(design.range_m.mean());
  std::vector<EchoGain> gains;
  gains.reserve(echoes.size());
  for (Eigen::Index k = 0; k < design.along_m.size(); ++k)
    gains.push_back({design.cofactors * Eigen::Vector2d(-design.along_m(k), 1), line.normal()});
  return sigma_m * sigma_m * design.cofactors +
         SharedCovariance(echoes, gains, {config.sound_speed, config.yaw_rad_per_m}, noise);
}

}  // namespace

void WallSegmentConfig::Describe(Archive& a) {
  a.Number("most_m", most_m, {"m", 0.5, 6, "largest length of a segment"});
  a.Number("reach_m", reach_m, {"m", 0.05, 2, "an echo so far beyond an end still is of the wall"});
  a.Number("gate", gate, {"-", 1, 10, "largest residual of an echo, in sigmas"});
  a.Number("most_rms", most_rms, {"-", 1, 10, "RMS of the residuals at which it grows no more, in sigmas"});
  a.Number("sound_speed", sound_speed, {"-", 0, 0.1, "sigma of the scale of all ranges"});
  a.Number("yaw_rad_per_m", yaw_rad_per_m, {"rad/m", 0, 0.2, "sigma of the odometry's turn per metre"});
  a.Integer("most_echoes", most_echoes, {"-", 20, 1000, "echoes that are kept of one segment"});
  a.Section("range", range, "noise of a range, and which series of ranges is a wall's");
}

std::optional<SegmentLine> FitSegment(const std::vector<PlacedEcho>& echoes, double angle_rad,
                                      const WallSegmentConfig& config, const OdometryNoise& noise) {
  constexpr int kSteps = 3;
  constexpr std::size_t kLeast = 3;
  if (echoes.size() < kLeast) return std::nullopt;
  SegmentLine line{.angle_rad = angle_rad, .anchor = MiddleOf(echoes)};
  Design design;
  for (int i = 0; i <= kSteps; ++i) design = Improve(echoes, line);
  // Written so that NaN is refused.
  if (!(std::abs(WrapAngle(line.angle_rad - angle_rad)) < Radians(config.range.most_bearing_deg)))
    return std::nullopt;
  line.covariance = CovarianceOf(echoes, design, line, config, noise);
  if (!line.covariance.allFinite()) return std::nullopt;
  return line;
}

WallSegment::WallSegment(const WallSegmentConfig& config, const OdometryNoise& noise,
                         std::vector<PlacedEcho> echoes, const SegmentLine& line)
    : config_(config), noise_(noise), echoes_(std::move(echoes)), line_(line) {
  from_.heard = to_.heard = echoes_.front().Foot(line_.normal());
  for (const PlacedEcho& echo : echoes_) Reach(echo);
  FindEnds();
}

bool WallSegment::Takes(const PlacedEcho& echo) const {
  const double off_axis = std::abs(WrapAngle(line_.angle_rad - echo.odom_from_sonar.yaw));
  if (!grows_ || off_axis > Radians(config_.range.most_bearing_deg)) return false;
  const Eigen::Vector2d at = echo.odom_from_sonar.translation() - line_.anchor;
  const double along_m = line_.along().dot(at);
  const double low_m = line_.along().dot(from_.heard - line_.anchor),
               high_m = line_.along().dot(to_.heard - line_.anchor);
  if (std::min(along_m, low_m) < std::max(along_m, high_m) - config_.most_m) return false;
  if (along_m < low_m - config_.reach_m || along_m > high_m + config_.reach_m) return false;
  const Eigen::Vector2d by_line(-along_m, 1);
  const double driven_m = std::max(0.0, echo.travel_m - newest().travel_m);
  const double lever_m =
      line_.along().dot(echo.odom_from_base.translation() - newest().odom_from_base.translation());
  const double variance =
      by_line.dot(line_.covariance * by_line) + std::pow(config_.range.SigmaOf(echo.range_m), 2) +
      driven_m * (std::pow(noise_.drift_m_per_sqrt_m, 2) + std::pow(noise_.yaw_rad_per_sqrt_m * lever_m, 2));
  const double residual = echo.range_m - (line_.distance_m - line_.normal().dot(at));
  return std::abs(residual) <= config_.gate * std::sqrt(variance);
}

bool WallSegment::EndsBefore(const PlacedEcho& echo) const {
  const Eigen::Vector2d along = line_.along();
  const double at_m = along.dot(echo.odom_from_sonar.translation());
  return at_m < along.dot(from_.heard) || at_m > along.dot(to_.heard);
}

bool WallSegment::Add(const std::vector<PlacedEcho>& echoes) {
  std::vector<PlacedEcho> all = echoes_;
  all.insert(all.end(), echoes.begin(), echoes.end());
  const auto line = FitSegment(all, line_.angle_rad, config_, noise_);
  const double sigma_m = config_.range.SigmaOf(all.back().range_m);
  if (!line || line->rms_m > config_.most_rms * sigma_m) return grows_ = false;
  echoes_ = std::move(all);
  line_ = *line;
  for (const PlacedEcho& echo : echoes) Reach(echo);
  FindEnds();
  Thin();
  return true;
}

void WallSegment::Reach(const PlacedEcho& echo) {
  const Eigen::Vector2d foot = echo.Foot(line_.normal()), along = line_.along();
  if (along.dot(foot - from_.heard) < 0) from_.heard = foot, from_.grew = true;
  if (along.dot(foot - to_.heard) > 0) to_.heard = foot, to_.grew = true;
}

/// What was known better before its echoes were thinned out stays.
void WallSegment::FindEnd(End& end, const Eigen::Vector2d& outward) const {
  std::vector<EchoBeside> beside;
  beside.reserve(echoes_.size());
  for (const PlacedEcho& echo : echoes_) {
    const Eigen::Vector2d at = echo.odom_from_sonar.translation() - line_.anchor;
    beside.push_back({outward.dot(at), line_.distance_m - line_.normal().dot(at), echo.range_m});
  }
  const WallEnd found = FindWallEnd(beside, config_.range);
  const bool better = std::exchange(end.grew, false) || found.sigma_m <= end.sigma_m;
  const double along_m = better ? found.along_m : outward.dot(end.at - line_.anchor);
  if (better) end.sigma_m = found.sigma_m;
  end.at = line_.anchor + line_.distance_m * line_.normal() + along_m * outward;
}

void WallSegment::FindEnds() {
  FindEnd(from_, -line_.along());
  FindEnd(to_, line_.along());
}

/// Every second one goes, but not the newest.
void WallSegment::Thin() {
  if (static_cast<int>(echoes_.size()) <= config_.most_echoes) return;
  std::vector<PlacedEcho> rest;
  for (std::size_t i = (echoes_.size() - 1) % 2; i < echoes_.size(); i += 2) rest.push_back(echoes_[i]);
  echoes_ = std::move(rest);
}

}  // namespace priamos::robot
