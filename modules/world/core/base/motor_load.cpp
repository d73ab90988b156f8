#include "world/core/base/motor_load.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr double kGravity = 9.81;
/// Below this speed the rolling resistance is what the motion needs, not its full value.
constexpr double kRolls_m_s = 0.005;

}  // namespace

void MotorLoadConfig::Describe(Archive& a) {
  a.Number("mass_kg", mass_kg, {"kg", 5, 2000, "nominal mass of the robot"});
  a.Number("mass_error", mass_error, {"-", 0, 0.5, "the true mass is off by up to this part"});
  a.Number("traction", traction, {"-", 0.1, 1.5, "friction coefficient between wheels and floor"});
  a.Number("full_slide_m_s", full_slide_m_s, {"m/s", 0.001, 1, "sliding speed of full friction"});
  a.Number("rolling_resistance", rolling_resistance, {"-", 0, 0.2, "of the weight"});
  a.Number("newton_per_ampere", newton_per_ampere, {"N/A", 0.1, 1000, "force at the rim per current"});
  a.Number("lag_s", lag_s, {"s", 0.001, 0.2, "time constant of the current"});
  a.Number("noise_a", noise_a, {"A", 0, 5, "standard deviation of one reading"});
  a.Number("offset_a", offset_a, {"A", 0, 5, "each sensor is off by up to this"});
}

MotorLoad::MotorLoad(const MotorLoadConfig& config, Rng rng)
    : config_(config),
      rng_(rng),
      mass_kg_(config.mass_kg * (1 + rng_.Uniform(-config.mass_error, config.mass_error))) {
  for (double& offset : offset_a_) offset = rng_.Uniform(-config.offset_a, config.offset_a);
}

void MotorLoad::Step(const PerWheel& rolled_m_s, const PerWheel& slid_m_s, double dt_s) {
  const double quarter_kg = mass_kg_ / 4, grip_n = config_.traction * quarter_kg * kGravity;
  const double follow = 1 - std::exp(-dt_s / config_.lag_s);
  for (std::size_t i = 0; i < 4; ++i) {
    const double slide = std::clamp(slid_m_s[i] / config_.full_slide_m_s, -1.0, 1.0);
    const double accelerating = quarter_kg * (rolled_m_s[i] - rolled_m_s_[i]) / dt_s * (1 - std::abs(slide));
    const double rolling = config_.rolling_resistance * quarter_kg * kGravity *
                           std::clamp(rolled_m_s[i] / kRolls_m_s, -1.0, 1.0);
    const double force_n = std::clamp(accelerating + slide * grip_n, -grip_n, grip_n) + rolling;
    const double wanted_a = released_[i] ? 0 : force_n / config_.newton_per_ampere;
    current_a_[i] += follow * (wanted_a - current_a_[i]);
  }
  rolled_m_s_ = rolled_m_s;
}

PerWheel MotorLoad::Read() {
  PerWheel reading = current_a_;
  for (std::size_t i = 0; i < 4; ++i) reading[i] += offset_a_[i] + rng_.Normal(config_.noise_a);
  return reading;
}

}  // namespace priamos::world
