#include "cli/scenario/free_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/robot/braking_law.hpp"

namespace priamos::cli {
namespace {

constexpr double kBeside_m = 0.06, kAhead_m = 0.20;
constexpr BrakingLaw kBraking{.latency_s = 0.2};  // slower than the robot, which means to need 0.12 s
constexpr std::array kParts{0.0, 0.25, 0.5, 0.75, 1.0};

world::Body WithMargin(world::Body body, double margin_m) {
  body.size_m.array() += 2 * margin_m;
  return body;
}

Twist2 Scaled(const Twist2& twist, double x, double y, double turn) {
  return {x * twist.vx, y * twist.vy, turn * twist.wz};
}

}  // namespace

FreeMotion::FreeMotion(const TrueWorld& world)
    : lever_m_(world.body.size_m.norm() / 2),
      bare_(world.body, world.solids),
      guarded_(WithMargin(world.body, kBeside_m), world.solids) {}

double FreeMotion::SpeedOf(const Twist2& motion) const {
  return std::hypot(motion.vx, motion.vy) + std::abs(motion.wz) * lever_m_;
}

double FreeMotion::Along(const Twist2& wish, const Twist2& motion) const {
  const Eigen::Vector3d w(wish.vx, wish.vy, wish.wz * lever_m_),
      m(motion.vx, motion.vy, motion.wz * lever_m_);
  return w.norm() > 0 ? m.dot(w) / w.norm() : 0;
}

/// Until the guarded footprint meets something, at most `farthest`. The gap shrinks by at most 1 per
/// distance.
double FreeMotion::FreeDistance(const Pose2& map_from_base, const Twist2& per_metre, double farthest) const {
  constexpr double kTouch = 1e-3, kLeastStep = 5e-3, kProbe = 0.01, kSliding = 0.05;
  double gap = guarded_.Gap(map_from_base, farthest + kTouch);
  if (gap < kTouch) {
    // Nearer than the margin: what does not close in any further is free.
    const auto bare_gap = [&](double travel) {
      return bare_.Gap(Integrate(map_from_base, per_metre, travel), kBeside_m + 2 * kProbe);
    };
    return bare_gap(kProbe) < bare_gap(0) - kSliding * kProbe ? 0 : farthest;
  }
  double travel = 0;
  while (gap >= kTouch && travel < farthest) {
    travel += std::max(gap, kLeastStep);
    gap = guarded_.Gap(Integrate(map_from_base, per_metre, travel), farthest + kTouch);
  }
  return std::min(travel, farthest);
}

/// The part of `motion` from which the base can stand in time.
double FreeMotion::Scale(const Pose2& map_from_base, const Twist2& motion) const {
  const double speed = SpeedOf(motion), gap = kAhead_m - kBeside_m;
  if (speed < 1e-6) return 1;
  const double enough = gap + kBraking.Distance(speed);
  const double free = FreeDistance(map_from_base, Scaled(motion, 1 / speed, 1 / speed, 1 / speed), enough);
  return free >= enough ? 1 : std::min(1.0, kBraking.SpeedWithin(free - gap) / speed);
}

Twist2 FreeMotion::Of(const Pose2& map_from_base, const Twist2& wish) const {
  const double scale = Scale(map_from_base, wish);
  Twist2 best = Scaled(wish, scale, scale, scale);
  if (scale >= 1) return best;
  for (const double x : kParts)
    for (const double y : kParts)
      for (const double turn : kParts) {
        if (std::max({x, y, turn}) < 1) continue;
        const Twist2 motion = Scaled(wish, x, y, turn);
        if (Along(wish, motion) <= Along(wish, best)) continue;
        const double part = Scale(map_from_base, motion);
        if (part * Along(wish, motion) > Along(wish, best)) best = Scaled(motion, part, part, part);
      }
  return best;
}

}  // namespace priamos::cli
