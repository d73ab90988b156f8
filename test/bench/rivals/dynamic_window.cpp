#include "test/bench/rivals/dynamic_window.hpp"

#include <algorithm>
#include <cmath>

#include "test/bench/rivals/free_ranges.hpp"

namespace priamos::bench {
namespace {

constexpr int kOfDisc = 7, kOfRectangle = 4, kTurns = 2;  ///< steps of the window to either side
constexpr double kLook_s = 0.1, kLongest_s = 4;           ///< of a trajectory of the rectangle
constexpr double kStands_m_s = 0.01;
/// The heading is looked at after so long.
constexpr double kAhead_s = 0.5;

bool Inside(const Eigen::Vector2d& point, double margin_m) {
  return std::abs(point.x()) < kDrawnBody.length_m / 2 + margin_m &&
         std::abs(point.y()) < kDrawnBody.width_m / 2 + margin_m;
}

/// How far a point is inside of the rectangle with its margin.
double Depth(const Eigen::Vector2d& point, double margin_m) {
  return std::min(kDrawnBody.length_m / 2 + margin_m - std::abs(point.x()),
                  kDrawnBody.width_m / 2 + margin_m - std::abs(point.y()));
}

}  // namespace

void DynamicWindowConfig::Describe(Archive& a) {
  a.Number("margin_m", margin_m, {"m", 0, 1, "added to the disc or the rectangle"});
  a.Number("heading", heading, {"-", 0, 100, "weight"});
  a.Number("distance", distance, {"-", 0, 100, "weight"});
  a.Number("velocity", velocity, {"-", 0, 100, "weight"});
  a.Number("braking_m_s2", braking_m_s2,
           {"m/s^2", 0.01, 5, "with which it can be braked before what it meets"});
  a.Number("window_s", window_s, {"s", 0.05, 5, "what can be reached in this time is the window"});
  a.Number("look_m", look_m, {"m", 0.1, 10, "free distance beyond which more is no better"});
}

std::vector<Twist2> DynamicWindow::Window(const Situation& situation) const {
  const int n = turns() ? kOfRectangle : kOfDisc, n_turns = turns() ? kTurns : 0;
  const double reach = config_.acceleration_m_s2 * config_.window_s;
  const double turn = config_.turn_acceleration_rad_s2 * config_.window_s;
  const Twist2& now = situation.commanded;
  std::vector<Twist2> window{{}};
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n_turns; k <= n_turns; ++k) {
        Twist2 twist{now.vx + i * reach / n, now.vy + j * reach / n, 0};
        if (n_turns > 0)
          twist.wz =
              std::clamp(now.wz + k * turn / n_turns, -config_.most_turn_rad_s, config_.most_turn_rad_s);
        const double too_fast = std::hypot(twist.vx, twist.vy) / situation.speed_m_s;
        if (too_fast > 1) twist = {twist.vx / too_fast, twist.vy / too_fast, twist.wz};
        window.push_back(twist);
      }
  return window;
}

double DynamicWindow::FreeOfRectangle(const Situation& situation, const Twist2& twist) const {
  const double speed = std::hypot(twist.vx, twist.vy) + 0.6 * std::abs(twist.wz);
  const double to_s = std::min(kLongest_s, config_.look_m / std::max(kStands_m_s, speed));
  for (double t = kLook_s; t <= to_s; t += kLook_s) {
    const Pose2 there = Integrate({}, twist, t), from_base = there.Inverse();
    for (const Eigen::Vector2d& point : situation.points) {
      const Eigen::Vector2d at = from_base * point;
      // What is inside already may be left.
      if (Inside(at, config_.margin_m) &&
          Depth(at, config_.margin_m) > std::max(0.0, Depth(point, config_.margin_m)) + 0.001)
        return speed * (t - kLook_s);
    }
  }
  return config_.look_m;
}

double DynamicWindow::FreeDistance(const Situation& situation, const Twist2& twist) const {
  if (turns()) return FreeOfRectangle(situation, twist);
  return FreeRange(situation.points, config_.radius_m + config_.margin_m, std::atan2(twist.vy, twist.vx),
                   config_.look_m);
}

/// Nothing for what cannot be braked in time.
std::optional<double> DynamicWindow::Value(const Situation& situation, const Twist2& twist) const {
  const double speed = std::hypot(twist.vx, twist.vy);
  const bool stands = speed < kStands_m_s && std::abs(twist.wz) < kStands_m_s;
  const double free_m = stands ? 0 : FreeDistance(situation, twist);
  if (!stands && speed > std::sqrt(2 * free_m * config_.braking_m_s2)) return std::nullopt;
  if (speed < kStands_m_s && stands) return 0.0;
  const Eigen::Vector2d course =
      speed < kStands_m_s ? situation.target.normalized() : Eigen::Vector2d(twist.vx, twist.vy) / speed;
  const double off = std::acos(std::clamp(course.dot(situation.target.normalized()), -1.0, 1.0));
  const double head_off = std::abs(WrapAngle(situation.way_rad - kAhead_s * twist.wz));
  const double heading = 1 - (turns() ? 0.75 * off + 0.25 * head_off : off) / kPi;
  return config_.heading * heading + config_.distance * free_m / config_.look_m +
         config_.velocity * speed / situation.speed_m_s;
}

Twist2 DynamicWindow::Choose(const Situation& situation) {
  Twist2 best{};
  double best_value = -1;
  for (const Twist2& twist : Window(situation)) {
    const auto value = Value(situation, twist);
    if (!value || *value <= best_value) continue;
    best_value = *value;
    best = twist;
  }
  // Where the way ends within the window it is braked.
  const double near = std::sqrt(2 * situation.target.norm() * config_.braking_m_s2);
  const double share = std::min(1.0, near / std::max(1e-3, situation.speed_m_s));
  return {share * best.vx, share * best.vy, best.wz};
}

}  // namespace priamos::bench
