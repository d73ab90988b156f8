#include "world/core/head/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/robot/braking_law.hpp"

namespace priamos::world {
namespace {

void DescribeAxis(AxisConfig& c, Archive& a, const std::string& unit, double limit) {
  const auto number = [&](const char* name, const char* per, double& value, double low, const char* doc) {
    const std::string shown = unit + per;
    std::string key = fmt::format("{}_{}", name, shown);
    key.erase(std::remove_if(key.begin(), key.end(), [](char k) { return k == '/' || k == '^'; }), key.end());
    a.Number(key, value, {shown, low, limit, doc});
  };
  number("min", "", c.min, -limit, "lower end stop");
  number("max", "", c.max, -limit, "upper end stop");
  if (!(c.min < c.max)) a.Refuse(fmt::format("max_{}", unit), "more than the lower end stop");
  number("motor_step", "", c.step, 1e-6, "one step of the motor");
  number("speed", "/s", c.speed, 1e-3, "greatest speed");
  number("acceleration", "/s^2", c.acceleration, 1e-3, "acceleration and braking");
  number("backlash", "", c.backlash, 0, "play between motor and axis");
  number("repeatability", "", c.repeatability, 0, "standard deviation of the place of rest");
}

}  // namespace

void AngleAxisConfig::Describe(Archive& a) {
  DescribeAxis(*this, a, "rad", 100);
}

void LensAxisConfig::Describe(Archive& a) {
  DescribeAxis(*this, a, "step", 1e5);
}

Axis::Axis(const AxisConfig& config, double start, Rng rng)
    : config_(config),
      rng_(rng),
      target_(start),
      motor_(start),
      axis_(start + rng_.Uniform(-0.5, 0.5) * config.backlash),
      rest_error_(rng_.Normal(config.repeatability)) {}

double Axis::counter() const {
  return std::round(motor_ / config_.step) * config_.step;
}

void Axis::MoveTo(double target) {
  const double rounded =
      std::round(std::clamp(target, config_.min, config_.max) / config_.step) * config_.step;
  if (rounded == target_) return;
  target_ = rounded;
  moving_ = true;
  rest_error_ = rng_.Normal(config_.repeatability);
}

void Axis::Step(Duration step) {
  if (!moving_) return;
  const double dt = Seconds(step), change = config_.acceleration * dt;
  const double travel = target_ - motor_;
  // Braking step by step takes half a step longer. The law holds for angles as it does for distances.
  const BrakingLaw braking{.deceleration_m_s2 = config_.acceleration, .latency_s = dt / 2};
  const double brakable = braking.SpeedWithin(std::abs(travel));
  const double wanted = std::copysign(std::min(config_.speed, brakable), travel);
  speed_ += std::clamp(wanted - speed_, -change, change);
  motor_ += speed_ * dt;
  if (std::abs(target_ - motor_) <= config_.step / 2 && std::abs(speed_) <= 2 * change) {
    motor_ = target_;
    speed_ = 0;
    moving_ = false;
  }
  axis_ = std::clamp(axis_, motor_ - config_.backlash / 2, motor_ + config_.backlash / 2);
}

}  // namespace priamos::world
