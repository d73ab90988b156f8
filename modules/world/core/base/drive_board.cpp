#include "world/core/base/drive_board.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::world {

void DriveBoardConfig::Describe(Archive& a) {
  a.Number("max_speed_rad_s", max_speed_rad_s, {"rad/s", 1, 30, "fastest wheel speed"});
  a.Number("acceleration_rad_s2", acceleration_rad_s2, {"rad/s^2", 1, 200, "slope of the speed ramp"});
  a.Number("braking_rad_s2", braking_rad_s2, {"rad/s^2", 1, 200, "slope of the ramp of a deadline stop"});
  a.Number("lag_s", lag_s, {"s", 0.001, 0.5, "time constant with which a wheel follows its ramp"});
  a.Number("deadline_s", deadline_s, {"s", 0.05, 1, "silence after which all wheels stop"});
  a.Integer("ticks_per_turn", ticks_per_turn, {"tick", 16, 1000000, "encoder counts per wheel turn"});
  a.Number("encoder_noise_ticks", encoder_noise_ticks, {"tick", 0, 50, "standard deviation of one reading"});
}

bool DriveBoard::Command(Time arrival, std::int32_t instance, const PerWheel& speed_rad_s) {
  if (!std::all_of(speed_rad_s.begin(), speed_rad_s.end(), [](double s) { return std::isfinite(s); }))
    return false;
  if (instance != instance_ && !Silent(arrival)) {
    last_foreign_ = arrival;
    ++foreign_commands_;
    return true;
  }
  if (instance != instance_) last_foreign_.reset();  // it commands alone now
  instance_ = instance;
  last_command_ = arrival;
  for (std::size_t i = 0; i < 4; ++i)
    set_rad_s_[i] = std::clamp(speed_rad_s[i], -config_.max_speed_rad_s, config_.max_speed_rad_s);
  return true;
}

bool DriveBoard::Silent(Time now) const {
  return !last_command_ || now - *last_command_ >= FromSeconds(config_.deadline_s);
}

bool DriveBoard::Stands() const {
  return speed_rad_s_ == PerWheel{};
}

bool DriveBoard::Contested(Time now) const {
  return last_foreign_ && now - *last_foreign_ < FromSeconds(config_.deadline_s);
}

void DriveBoard::Step(Time now, Duration step) {
  deadline_stopped_ = Silent(now);
  contested_ = Contested(now) || (contested_ && !Stands());
  const bool held = deadline_stopped_ || contested_;
  const double dt = Seconds(step);
  const double change = dt * (held ? config_.braking_rad_s2 : config_.acceleration_rad_s2);
  const double follow = 1 - std::exp(-dt / config_.lag_s);
  for (std::size_t i = 0; i < 4; ++i) {
    const double target = held || stalled_[i] ? 0 : set_rad_s_[i];
    ramp_rad_s_[i] += std::clamp(target - ramp_rad_s_[i], -change, change);
    const double before = speed_rad_s_[i];
    speed_rad_s_[i] += follow * (ramp_rad_s_[i] - before);
    // Friction holds a wheel whose set value is 0 and which hardly turns.
    if (target == 0 && ramp_rad_s_[i] == 0 && std::abs(speed_rad_s_[i]) < 0.005) speed_rad_s_[i] = 0;
    turned_rad_[i] += dt * (before + speed_rad_s_[i]) / 2;
  }
}

WheelReading DriveBoard::Read() {
  WheelReading reading;
  for (std::size_t i = 0; i < 4; ++i) {
    // An encoder at rest does not jitter: only moving pulse edges can be early or late.
    const double noise = speed_rad_s_[i] != 0 ? rng_.Normal(config_.encoder_noise_ticks) : 0;
    const double ticks = turned_rad_[i] / (2 * kPi) * config_.ticks_per_turn + noise;
    reading.position_ticks[i] = static_cast<std::int32_t>(static_cast<std::int64_t>(std::floor(ticks)));
  }
  reading.deadline_stopped = deadline_stopped_;
  reading.contested = contested_;
  reading.instance = instance_;
  reading.foreign_commands = foreign_commands_;
  return reading;
}

}  // namespace priamos::world
