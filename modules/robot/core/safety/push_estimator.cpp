#include "robot/core/safety/push_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr Duration kWindow = std::chrono::milliseconds(120);
constexpr double kGravity = 9.81;
/// Slower than this a wheel need not overcome its full rolling resistance.
constexpr double kRolls_m_s = 0.01;
/// Fewer samples in the window than this say nothing.
constexpr std::size_t kLeastSamples = 4;

/// Forgets what is older than the window, and everything when time stepped back.
template <class Sample>
void Keep(std::deque<Sample>& samples, const Sample& newest) {
  if (!samples.empty() && newest.time <= samples.back().time) samples.clear();
  samples.push_back(newest);
  while (samples.size() > 2 && newest.time - samples[1].time >= kWindow) samples.pop_front();
}

/// Forces of the four wheels along their rolling directions as one of the base: x, y, torque over the lever.
Eigen::Vector3d BodyForce(const std::array<double, 4>& wheels) {
  const auto [fl, fr, rl, rr] = wheels;
  return {fl + fr + rl + rr, -fl + fr + rl - rr, -fl + fr - rl + rr};
}

}  // namespace

void PushConfig::Describe(Archive& a) {
  a.Number("mass_kg", mass_kg, {"kg", 5, 2000, "mass of the robot"});
  a.Number("newton_per_ampere", newton_per_ampere, {"N/A", 0.1, 1000, "force at the rim per current"});
  a.Number("rolling_resistance", rolling_resistance, {"-", 0, 0.2, "of the weight"});
}

void PushEstimator::AddMotion(Time time, const Twist2& twist) {
  const Eigen::Vector3d velocity(twist.vx, twist.vy, geometry_.lever_m * twist.wz);
  const Motion before = motions_.empty() ? Motion{time, Eigen::Vector3d::Zero()} : motions_.back();
  Keep(motions_, {time, before.travel_m + velocity * Seconds(time - before.time)});
}

void PushEstimator::AddCurrents(const MotorCurrents& currents) {
  Keep(currents_, currents);
}

std::optional<Eigen::Vector3d> PushEstimator::Push() const {
  const auto means = MeanMotion();
  if (!means) return std::nullopt;
  const auto force = MeanForce(*means);
  if (!force) return std::nullopt;
  return *force - config_.mass_kg * means->acceleration - Rolling(means->velocity);
}

std::optional<PushEstimator::Means> PushEstimator::MeanMotion() const {
  if (motions_.size() < kLeastSamples || motions_.back().time - motions_.front().time < kWindow)
    return std::nullopt;
  const Motion &first = motions_.front(), &middle = motions_[motions_.size() / 2], &last = motions_.back();
  const auto velocity = [](const Motion& a, const Motion& b) -> Eigen::Vector3d {
    return (b.travel_m - a.travel_m) / Seconds(b.time - a.time);
  };
  return Means{first.time, middle.time, last.time, velocity(first, last),
               2 * (velocity(middle, last) - velocity(first, middle)) / Seconds(last.time - first.time)};
}

/// By the currents, weighted with the triangle that a second difference weighs an acceleration with.
std::optional<Eigen::Vector3d> PushEstimator::MeanForce(const Means& means) const {
  std::array<double, 4> sum{};
  double weights = 0;
  std::size_t samples = 0;
  for (const MotorCurrents& c : currents_) {
    const double weight = std::min(Seconds(c.time - means.from) / Seconds(means.middle - means.from),
                                   Seconds(means.to - c.time) / Seconds(means.to - means.middle));
    if (weight <= 0) continue;
    for (std::size_t i = 0; i < 4; ++i) sum[i] += weight * c.current_a[i];
    weights += weight;
    ++samples;
  }
  if (samples + 1 < kLeastSamples) return std::nullopt;
  return BodyForce(sum) * config_.newton_per_ampere / weights;
}

Eigen::Vector3d PushEstimator::Rolling(const Eigen::Vector3d& velocity) const {
  const WheelSpeeds speeds =
      ToWheelSpeeds(geometry_, {velocity.x(), velocity.y(), velocity.z() / geometry_.lever_m});
  const double most_n = config_.rolling_resistance * config_.mass_kg * kGravity / 4;
  std::array<double, 4> force{};
  for (std::size_t i = 0; i < 4; ++i)
    force[i] = most_n * std::clamp(speeds[i] * geometry_.wheel_radius_m / kRolls_m_s, -1.0, 1.0);
  return BodyForce(force);
}

}  // namespace priamos::robot
