#include "robot/core/base/odometry.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/square.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kAheadAllowed{100};
// Longer than any reordering: the sender's clock itself has stepped back.
constexpr int kLateUntilRestart = 25;
constexpr milliseconds kLateSpan{500};
// Sampling jitter of the drive board must not look like a wheel that is too fast.
constexpr double kSpeedHeadroom = 1.5;
constexpr double kTickHeadroom = 8;

/// Signed distance of two counters that may have wrapped between.
std::int32_t TickDifference(std::int32_t to, std::int32_t from) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from));
}

}  // namespace

OdometryStep OdometryStep::Slipping(double factor) const {
  OdometryStep step = *this;
  if (!known) return step;
  step.wander.variance *= factor;
  step.noise *= std::max(1.0, factor);
  return step;
}

void OdometryNoise::Describe(Archive& a) {
  a.Number("slip_length_m", slip_length_m,
           {"m", 0.01, 10, "distance after which a wheel's slip is forgotten"});
  a.Number("forward_m_per_sqrt_m", forward_m_per_sqrt_m, {"m/sqrt(m)", 0, 0.2, "forward error"});
  a.Number("sideways_m_per_sqrt_m", sideways_m_per_sqrt_m,
           {"m/sqrt(m)", 0, 0.2, "error along y when driving sideways"});
  a.Number("drift_m_per_sqrt_m", drift_m_per_sqrt_m, {"m/sqrt(m)", 0, 0.2, "error across the path"});
  a.Number("yaw_rad_per_sqrt_m", yaw_rad_per_sqrt_m, {"rad/sqrt(m)", 0, 0.2, "heading error by driving"});
  a.Number("yaw_rad_per_sqrt_rad", yaw_rad_per_sqrt_rad,
           {"rad/sqrt(rad)", 0, 0.2, "heading error by turning"});
  a.Number("slip_floor_m_s", slip_floor_m_s, {"m/s", 0, 0.5, "slip residual that encoder steps explain"});
  a.Number("slip_variance_m2_per_m", slip_variance_m2_per_m,
           {"m^2/m", 0, 1, "variance added per metre of slip above the floor"});
}

void OdometryConfig::Describe(Archive& a) {
  a.Number("ticks_per_turn", ticks_per_turn, {"tick", 16, 1e6, "encoder counts per turn of a wheel"});
  a.Number("unknown_speed_m_s", unknown_speed_m_s,
           {"m/s", 0.05, 2, "speed assumed as sigma while encoders are not credible"});
  a.Section("noise", noise, "how odometry errors grow; sigma grows with the root of the distance");
}

std::optional<OdometryStep> Odometry::Add(const WheelSample& sample, Time now) {
  if (RefusedByTime(sample, now)) {
    if (late_in_a_row_ < kLateUntilRestart) return std::nullopt;
    late_in_a_row_ = 0;
    ++counters_.restarts;
    return Accept(UnknownStep(sample, sample.time, kLateSpan), sample);
  }
  if (!last_) {
    last_ = sample;
    ++counters_.accepted;
    return std::nullopt;
  }
  if (IsPlausible(*last_, sample)) return Accept(KnownStep(sample), sample);
  ++counters_.jumps;
  const bool confirmed = candidate_ && sample.time > candidate_->time && IsPlausible(*candidate_, sample);
  if (!confirmed) {
    candidate_ = sample;
    return std::nullopt;
  }
  ++counters_.restarts;
  return Accept(UnknownStep(sample, last_->time, sample.time - last_->time), sample);
}

std::optional<Time> Odometry::time() const {
  return last_ ? std::optional(last_->time) : std::nullopt;
}

bool Odometry::RefusedByTime(const WheelSample& sample, Time now) {
  if (sample.time > now + kAheadAllowed) {
    ++counters_.from_future;
    return true;
  }
  if (!last_ || sample.time > last_->time) {
    late_in_a_row_ = 0;
    return false;
  }
  if (sample.time == last_->time) {
    ++counters_.doubles;
    return true;
  }
  ++counters_.late;
  ++late_in_a_row_;
  return true;
}

bool Odometry::IsPlausible(const WheelSample& from, const WheelSample& to) const {
  const double turns_per_s = geometry_.max_wheel_rad_s / (2 * kPi);
  const double most =
      kSpeedHeadroom * turns_per_s * config_.ticks_per_turn * Seconds(to.time - from.time) + kTickHeadroom;
  for (std::size_t i = 0; i < 4; ++i) {
    if (std::abs(static_cast<double>(TickDifference(to.ticks[i], from.ticks[i]))) > most) return false;
  }
  return true;
}

OdometryStep Odometry::KnownStep(const WheelSample& to) const {
  OdometryStep step{.from = last_->time, .to = to.time};
  const double rad_per_tick = 2 * kPi / config_.ticks_per_turn;
  WheelSpeeds speeds{};
  for (std::size_t i = 0; i < 4; ++i)
    speeds[i] = TickDifference(to.ticks[i], last_->ticks[i]) * rad_per_tick / step.seconds();
  const WheelMotion motion = FromWheelSpeeds(geometry_, speeds);
  step.twist = motion.twist;
  step.slip_m_s = motion.slip_m_s;
  step.noise = Noise(motion.twist, motion.slip_m_s, step.seconds());
  step.wander = Wander(motion.twist, step.seconds());
  return step;
}

OdometryStep Odometry::UnknownStep(const WheelSample& to, Time from, Duration span) const {
  OdometryStep step{.from = from, .to = to.time};
  const double travel = config_.unknown_speed_m_s * Seconds(span);
  step.noise.diagonal() << Square(travel), Square(travel), Square(travel / geometry_.lever_m);
  step.known = false;
  return step;
}

Eigen::Matrix3d Odometry::Noise(const Twist2& twist, double slip_m_s, double seconds) const {
  const OdometryNoise& n = config_.noise;
  const double sideways = std::abs(twist.vy) * seconds;
  const double turn = std::abs(twist.wz) * seconds;
  const double slip =
      n.slip_variance_m2_per_m * std::max(0.0, std::abs(slip_m_s) - n.slip_floor_m_s) * seconds;
  // One radian of turning moves the wheels by the lever: their translation error comes from that distance
  // too.
  const double x = Square(n.drift_m_per_sqrt_m) * (sideways + turn);
  const double y = Square(n.sideways_m_per_sqrt_m) * sideways + Square(n.drift_m_per_sqrt_m) * turn;
  const double yaw = Square(n.yaw_rad_per_sqrt_m) * sideways + Square(n.yaw_rad_per_sqrt_rad) * turn;
  return Eigen::Vector3d(x + slip, y + slip, yaw + slip / Square(geometry_.lever_m)).asDiagonal();
}

/// A process that is forgotten after the length l and has the variance w^2 / 2l at any time walks, over many
/// l, like a random walk of w per root metre.
OdometryWander Odometry::Wander(const Twist2& twist, double seconds) const {
  const OdometryNoise& n = config_.noise;
  const double kept = std::exp(-std::hypot(twist.vx, twist.vy) * seconds / n.slip_length_m);
  const Eigen::Vector3d walk(n.forward_m_per_sqrt_m, n.yaw_rad_per_sqrt_m, n.drift_m_per_sqrt_m);
  return {kept, walk.cwiseAbs2() * (1 - Square(kept)) / (2 * n.slip_length_m)};
}

OdometryStep Odometry::Accept(const OdometryStep& step, const WheelSample& sample) {
  pose_ = Integrate(pose_, step.twist, step.seconds());
  twist_ = step.twist;
  slip_m_s_ = step.slip_m_s;
  last_ = sample;
  candidate_.reset();
  ++counters_.accepted;
  return step;
}

}  // namespace priamos::robot
