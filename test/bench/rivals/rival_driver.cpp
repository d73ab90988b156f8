#include "test/bench/rivals/rival_driver.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bench {
namespace {

constexpr int kFirstSteps = 15;  ///< 0.3 s, as the robot gets its path
constexpr double kStep_s = 0.02, kThere_m = 0.05;
/// How far ahead of its place the base is looked for on the path, in such steps.
constexpr double kPlaceAhead_m = 1.5, kPlaceStep_m = 0.02;

robot::WheelSample SampleOf(const world::WheelSample& heard) {
  return {heard.time, heard.reading.position_ticks, heard.reading.deadline_stopped};
}

}  // namespace

void RivalConfig::Describe(Archive& a) {
  a.Section("echoes", echoes, "memory of echoes");
  a.Number("ahead_m", ahead_m, {"m", 0.1, 10, "the target is so far ahead on the path"});
  a.Number("turn_gain", turn_gain, {"1/s", 0, 10, "turn rate per angle of the heading"});
  a.Number("most_turn_rad_s", most_turn_rad_s, {"rad/s", 0, 2, "fastest turn"});
  a.Flag("along_motion", along_motion, "the heading follows the motion, else the path");
  a.Number("slow_from_rad", slow_from_rad, {"rad", 0.01, 10, "heading farther off: slower"});
  a.Integer("steps_per_choice", steps_per_choice, {"-", 1, 50, "of 20 ms"});
}

RivalDriver::RivalDriver(const Order& order, const RivalConfig& config, std::unique_ptr<Method> method)
    : config_(config),
      method_(std::move(method)),
      odometry_({}, geometry_),
      echoes_(config.echoes),
      slew_({}),
      odom_from_map_(order.start.Inverse()),
      path_{order.start.translation()},
      speed_m_s_(order.path.speed_m_s) {
  for (const Pose2& point : order.path.points) {
    length_m_ += (point.translation() - path_.back()).norm();
    path_.push_back(point.translation());
  }
}

std::optional<world::PerWheel> RivalDriver::Step(const Heard& heard, Time now) {
  Hear(heard, now);
  if (++steps_ < kFirstSteps) return std::nullopt;
  if (steps_ % config_.steps_per_choice == 0) wanted_ = Wanted();
  const Twist2 twist = slew_.Step(wanted_, kStep_s);
  return robot::Saturated(geometry_, robot::ToWheelSpeeds(geometry_, twist));
}

void RivalDriver::Hear(const Heard& heard, Time now) {
  if (heard.wheels) odometry_.Add(SampleOf(*heard.wheels), now);
  if (heard.sonars) echoes_.Add({heard.sonars->time, heard.sonars->ranges_m}, odometry_.pose(), now);
}

Eigen::Vector2d RivalDriver::OnPath(double s) const {
  for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
    const Eigen::Vector2d line = path_[i + 1] - path_[i];
    if (s <= line.norm()) return path_[i] + s * line.normalized();
    s -= line.norm();
  }
  return path_.back();
}

/// The place on the path only advances.
void RivalDriver::Follow(const Eigen::Vector2d& at) {
  double nearest_m = (OnPath(done_m_) - at).norm();
  const double to_m = std::min(length_m_, done_m_ + kPlaceAhead_m);
  for (double s = done_m_; s <= to_m; s += kPlaceStep_m) {
    const double off_m = (OnPath(s) - at).norm();
    if (off_m >= nearest_m) continue;
    nearest_m = off_m;
    done_m_ = s;
  }
}

Situation RivalDriver::Look() {
  const Pose2 map_from_base = odom_from_map_.Inverse() * odometry_.pose();
  Follow(map_from_base.translation());
  const Pose2 base_from_map = map_from_base.Inverse();
  const Eigen::Vector2d target = OnPath(std::min(length_m_, done_m_ + config_.ahead_m));
  const Eigen::Vector2d from = OnPath(std::min(done_m_, length_m_ - 0.1));
  const Eigen::Vector2d way = base_from_map.rotation() * (OnPath(std::min(length_m_, done_m_ + 0.3)) - from);
  return {echoes_.Points(odometry_.pose()), base_from_map * target, std::atan2(way.y(), way.x()),
          slew_.commanded(), speed_m_s_};
}

Twist2 RivalDriver::Wanted() {
  const Situation situation = Look();
  if (done_m_ >= length_m_ && situation.target.norm() < kThere_m) return {};
  const Twist2 wanted = method_->Choose(situation);
  return method_->turns() ? wanted : Turned(wanted, situation);
}

/// Turns the heading along, and drives no faster than it follows.
Twist2 RivalDriver::Turned(Twist2 wanted, const Situation& situation) const {
  const double speed = std::hypot(wanted.vx, wanted.vy);
  double off = situation.way_rad;
  if (config_.along_motion && speed > 0.02) off = std::atan2(wanted.vy, wanted.vx);
  const double share = std::clamp(config_.slow_from_rad / std::max(1e-3, std::abs(off)), 0.3, 1.0);
  const double most = config_.most_turn_rad_s;
  return {share * wanted.vx, share * wanted.vy, std::clamp(config_.turn_gain * off, -most, most)};
}

}  // namespace priamos::bench
