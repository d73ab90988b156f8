#include "robot/core/safety/collision_stop.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kTouch = 1e-3;
constexpr double kRounding = 1e-6;
/// Skimming along a wall must not take a thousand steps; what this jumps over, the margin covers.
constexpr double kLeastStep = 5e-3;
/// Closing in by less than this part of the distance is sliding along, not driving into.
constexpr double kSliding = 0.05;
/// How far a point within the guard is probed.
constexpr double kProbe = 0.01;

Footprint WithMargin(const Footprint& footprint, double margin_m) {
  return {footprint.length_m + 2 * margin_m, footprint.width_m + 2 * margin_m};
}

/// Distance until `guard` meets `point`, at most `farthest`. The distance shrinks by at most 1 m per metre
/// driven, so a step as long as the distance never jumps over the contact.
double FreeDistance(const Footprint& guard, const Twist2& per_metre, const Eigen::Vector2d& point,
                    double farthest) {
  const auto distance_after = [&](double travel) {
    return guard.Distance(Integrate({}, per_metre, travel).Inverse() * point);
  };
  double distance = guard.Distance(point);
  if (distance < kTouch) return distance_after(kProbe) < distance - kSliding * kProbe ? 0 : farthest;
  double travel = 0;
  while (travel < farthest) {
    travel += std::max(distance, kLeastStep);
    if (travel >= farthest) break;
    distance = distance_after(travel);
    if (distance < kTouch) return travel;
  }
  return farthest;
}

CollisionStop::Nearest FirstMet(const Footprint& guard, const Twist2& per_metre,
                                std::span<const Eigen::Vector2d> points, double farthest) {
  CollisionStop::Nearest first{farthest, {0, 0}};
  for (const Eigen::Vector2d& point : points) {
    const double free_m = FreeDistance(guard, per_metre, point, first.free_m);
    if (free_m < first.free_m) first = {free_m, point};
  }
  return first;
}

/// Is a point within `guard` nearer after a motion than sliding along makes it? The deeper it is in the
/// margin, the less counts as sliding, and nothing where half of the margin is used up: what is tolerated at
/// every step must not add up to a contact.
bool ClosesIn(const Footprint& guard, double margin_m, const Eigen::Vector2d& point, const Pose2& from_base,
              double travel) {
  const double distance = guard.Distance(point);
  if (distance >= kTouch) return false;
  const double left = std::clamp(1 + distance / std::max(margin_m / 2, kTouch), 0.0, 1.0);
  return guard.Distance(from_base * point) < distance - kSliding * left * travel - kRounding;
}

/// Distance for which `guard` does not close in on any of the points within it, at most `farthest`. An arc
/// closes in with the square of the distance, so steps that double are fine enough; what is between two
/// counts as not free.
double DistanceKeptOff(const Footprint& guard, double margin_m, const Twist2& per_metre,
                       std::span<const Eigen::Vector2d> points, double farthest) {
  double kept_off = 0;
  for (double travel = kProbe; kept_off < farthest; travel *= 2) {
    const Pose2 from_base = Integrate({}, per_metre, travel).Inverse();
    for (const Eigen::Vector2d& point : points)
      if (ClosesIn(guard, margin_m, point, from_base, travel)) return kept_off;
    kept_off = travel;
  }
  return farthest;
}

}  // namespace

void CollisionStopConfig::Describe(Archive& a) {
  a.Number("margin_m", margin_m,
           {"m", 0, 0.5, "kept free on all sides; half the play in a door is the most"});
  a.Number("gap_m", gap_m, {"m", 0, 1, "where to stand before an obstacle ahead"});
  a.Number("braking_m_s2", braking.deceleration_m_s2, {"m/s^2", 0.05, 5, "deceleration the base manages"});
  a.Number("latency_s", braking.latency_s, {"s", 0, 1, "age of an echo when the wheels obey it"});
  a.Number("look_ahead_m", look_ahead_m, {"m", 0.5, 5, "echoes farther along the motion are not reported"});
  a.Number("memory_margin_m", memory_margin_m, {"m", -0.2, 0.5, "margin for remembered things"});
  a.Number("memory_gap_m", memory_gap_m, {"m", 0, 1, "where to stand before remembered things"});
}

CollisionStop::CollisionStop(const CollisionStopConfig& config, const Footprint& footprint)
    : config_(config),
      seen_guard_(WithMargin(footprint, config.margin_m)),
      memory_guard_(WithMargin(footprint, config.memory_margin_m)) {}

double CollisionStop::SpeedOf(const Twist2& twist) const {
  return std::hypot(twist.vx, twist.vy) + std::abs(twist.wz) * seen_guard_.Reach();
}

CollisionStop::Result CollisionStop::Limit(const Twist2& wanted, std::span<const Eigen::Vector2d> seen,
                                           std::span<const Eigen::Vector2d> remembered) const {
  Result result{wanted, 1, std::nullopt, std::nullopt};
  // Distance is that of the fastest point of the footprint, so that turning counts.
  const double speed = SpeedOf(wanted);
  if (speed < 1e-6) return result;
  const Twist2 per_metre{wanted.vx / speed, wanted.vy / speed, wanted.wz / speed};
  const Nearest of_seen = FirstMet(seen_guard_, per_metre, seen, config_.look_ahead_m);
  const Nearest of_memory = FirstMet(memory_guard_, per_metre, remembered, config_.look_ahead_m);
  const Nearest& nearest = of_memory.free_m < of_seen.free_m ? of_memory : of_seen;
  if (nearest.free_m >= config_.look_ahead_m) return result;

  const double allowed = std::min(config_.braking.SpeedWithin(of_seen.free_m - config_.gap_m),
                                  config_.braking.SpeedWithin(of_memory.free_m - config_.memory_gap_m));
  result.nearest = nearest;
  result.allowed = allowed;
  result.scale = std::min(1.0, allowed / speed);
  result.twist = {wanted.vx * result.scale, wanted.vy * result.scale, wanted.wz * result.scale};
  return result;
}

double CollisionStop::Scale(const Twist2& wanted, std::span<const Eigen::Vector2d> seen,
                            std::span<const Eigen::Vector2d> remembered) const {
  const double speed = SpeedOf(wanted);
  if (speed < 1e-6) return 1;
  const Twist2 per_metre{wanted.vx / speed, wanted.vy / speed, wanted.wz / speed};
  const double braking = config_.braking.Distance(speed);
  const auto allowed = [&](const Footprint& guard, double margin_m, std::span<const Eigen::Vector2d> points,
                           double gap_m) {
    const double kept_off = DistanceKeptOff(guard, margin_m, per_metre, points, braking);
    if (kept_off <= 0) return 0.0;
    const double enough = braking + gap_m, free = FirstMet(guard, per_metre, points, enough).free_m;
    return std::min(kept_off >= braking ? speed : config_.braking.SpeedWithin(kept_off),
                    free >= enough ? speed : config_.braking.SpeedWithin(free - gap_m));
  };
  const double of_seen = allowed(seen_guard_, config_.margin_m, seen, config_.gap_m);
  return std::min(of_seen,
                  allowed(memory_guard_, config_.memory_margin_m, remembered, config_.memory_gap_m)) /
         speed;
}

}  // namespace priamos::robot
