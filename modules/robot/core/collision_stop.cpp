#include "robot/core/collision_stop.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kTouch = 1e-3;
/// Skimming along a wall must not take a thousand steps; what this jumps over, the margin covers.
constexpr double kLeastStep = 5e-3;
/// Closing in by less than this part of the way is sliding along, not driving into.
constexpr double kSliding = 0.05;

}  // namespace

void CollisionStopConfig::Describe(Archive& a) {
  a.Number("margin_m", margin_m,
           {"m", 0, 0.5, "kept free on all sides; half the play in a door is the most"});
  a.Number("gap_m", gap_m, {"m", 0, 1, "where to stand before an obstacle ahead"});
  a.Number("braking_m_s2", braking_m_s2, {"m/s^2", 0.05, 5, "deceleration the base manages"});
  a.Number("latency_s", latency_s, {"s", 0, 1, "age of an echo when the wheels obey it"});
  a.Number("look_ahead_m", look_ahead_m, {"m", 0.5, 5, "echoes farther along the way are not reported"});
}

CollisionStop::CollisionStop(const CollisionStopConfig& config, const Footprint& footprint)
    : config_(config),
      guarded_{footprint.length_m + 2 * config.margin_m, footprint.width_m + 2 * config.margin_m} {}

CollisionStop::Result CollisionStop::Limit(const Twist2& wanted,
                                           std::span<const Eigen::Vector2d> points) const {
  Result result{wanted, 1, std::nullopt};
  // Way is that of the fastest point of the footprint, so that turning counts.
  const double speed = std::hypot(wanted.vx, wanted.vy) + std::abs(wanted.wz) * guarded_.Reach();
  if (speed < 1e-6) return result;
  const Twist2 per_metre{wanted.vx / speed, wanted.vy / speed, wanted.wz / speed};
  double free = config_.look_ahead_m;
  for (const Eigen::Vector2d& point : points) free = FreeWay(per_metre, point, free);
  if (free >= config_.look_ahead_m) return result;

  result.free_m = free;
  const double a = config_.braking_m_s2, lost = a * config_.latency_s;
  const double way = std::max(0.0, free - config_.gap_m);
  const double allowed = std::sqrt(lost * lost + 2 * a * way) - lost;
  result.scale = std::min(1.0, allowed / speed);
  result.twist = {wanted.vx * result.scale, wanted.vy * result.scale, wanted.wz * result.scale};
  return result;
}

/// Way until the guarded rectangle meets `point`, at most `farthest`. The distance shrinks by at most 1 per
/// way, so a step as long as the distance never jumps over the contact.
double CollisionStop::FreeWay(const Twist2& per_metre, const Eigen::Vector2d& point, double farthest) const {
  const auto distance_after = [&](double way) {
    return guarded_.Distance(Integrate({}, per_metre, way).Inverse() * point);
  };
  double distance = guarded_.Distance(point);
  if (distance < kTouch) {
    constexpr double kProbe = 0.01;
    return distance_after(kProbe) < distance - kSliding * kProbe ? 0 : farthest;
  }
  double way = 0;
  while (way < farthest) {
    way += std::max(distance, kLeastStep);
    if (way >= farthest) break;
    distance = distance_after(way);
    if (distance < kTouch) return way;
  }
  return farthest;
}

}  // namespace priamos::robot
