#include "test/robot/support/simulated_base.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr std::chrono::milliseconds kStep{2};
constexpr std::chrono::milliseconds kDeadline{200};
constexpr double kSlope = 15, kLag_s = 0.04, kTicksPerTurn = 4096;

}  // namespace

SimulatedBase::SimulatedBase(std::uint64_t seed, const Pose2& start, const Errors& errors)
    : errors_(errors),
      rng_(Rng::Stream(seed, "simulated base")),
      now_(FromUtime(1'000'000'000)),
      commanded_(now_),
      truth_(start) {
  lever_m_ = nominal_.lever_m * (1 + rng_.Uniform(-errors.lever, errors.lever));
  sideways_loss_ = rng_.Uniform(0, errors.sideways_loss);
  for (double& radius : radius_m_)
    radius = nominal_.wheel_radius_m * (1 + rng_.Uniform(-errors.radius, errors.radius));
  for (double& slip : slip_) slip = rng_.Normal(errors.slip);
}

void SimulatedBase::Command(const WheelSpeeds& speeds, Time now) {
  set_ = speeds;
  commanded_ = now;
}

void SimulatedBase::Advance(Duration time) {
  for (Duration done{}; done < time; done += kStep) {
    now_ += kStep;
    Step(Seconds(kStep));
  }
}

void SimulatedBase::Step(double dt) {
  const bool silent = now_ - commanded_ >= kDeadline;
  WheelSpeeds contact{};
  for (std::size_t i = 0; i < 4; ++i) {
    ramp_[i] += std::clamp((silent ? 0 : set_[i]) - ramp_[i], -kSlope * dt, kSlope * dt);
    speed_[i] += (ramp_[i] - speed_[i]) * (1 - std::exp(-dt / kLag_s));
    turned_[i] += speed_[i] * dt;
    const double rolled = radius_m_[i] * speed_[i];
    const double travel = std::min(1.0, std::abs(rolled) * dt / errors_.slip_length_m);
    slip_[i] += -slip_[i] * travel + errors_.slip * std::sqrt(2 * travel) * rng_.Normal(1);
    contact[i] = rolled * (1 - slip_[i]);
  }
  // Contact speeds are wheel speeds of a base with wheels of radius 1.
  twist_ = FromWheelSpeeds({.wheel_radius_m = 1, .lever_m = lever_m_}, contact).twist;
  twist_.vy *= 1 - sideways_loss_;
  truth_ = Integrate(truth_, twist_, dt);
}

WheelSample SimulatedBase::Read() const {
  WheelSample sample{.time = now_};
  for (std::size_t i = 0; i < 4; ++i)
    sample.ticks[i] = static_cast<std::int32_t>(std::floor(turned_[i] / (2 * kPi) * kTicksPerTurn));
  sample.deadline_stopped = now_ - commanded_ >= kDeadline;
  return sample;
}

}  // namespace priamos::robot
