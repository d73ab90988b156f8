#include "world/core/base/mecanum_base.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {

void MecanumConfig::Describe(Archive& a) {
  a.Number("wheel_radius_m", wheel_radius_m, {"m", 0.02, 0.5, "nominal wheel radius"});
  a.Number("half_wheelbase_m", half_wheelbase_m, {"m", 0.05, 2, "half the distance between the axles"});
  a.Number("half_track_m", half_track_m, {"m", 0.05, 2, "half the distance between left and right wheels"});
  a.Number("radius_error", radius_error, {"-", 0, 0.1, "each true radius is off by up to this part"});
  a.Number("lever_error", lever_error, {"-", 0, 0.1, "true wheelbase + track is off by up to this part"});
  a.Number("lateral_loss", lateral_loss, {"-", 0, 0.5, "up to this part of sideways motion is lost"});
  a.Number("roller_slip", roller_slip, {"-", 0, 0.2, "standard deviation of each wheel's wandering slip"});
  a.Number("slip_length_m", slip_length_m,
           {"m", 0.01, 10, "distance after which a wheel's slip is forgotten"});
  a.Number("acceleration_slip_s2_m", acceleration_slip_s2_m,
           {"s^2/m", 0, 0.2, "slip per acceleration of the contact"});
}

namespace {

/// A base that too few wheels drive rolls on, and comes to rest in about so long.
constexpr double kCoast_s = 1;

/// Contact speed of wheel `i` that agrees with the other three: front and rear pair have the same sum.
double FreeRolling(const PerWheel& c, std::size_t i) {
  constexpr std::array<std::size_t, 4> kBeside{1, 0, 3, 2};
  const double other_pair = i < 2 ? c[2] + c[3] : c[0] + c[1];
  return other_pair - c[kBeside[i]];
}

}  // namespace

MecanumBase::MecanumBase(const MecanumConfig& config, Rng rng) : config_(config), rng_(rng) {
  for (auto& radius : radius_m_)
    radius = config.wheel_radius_m * (1 + rng_.Uniform(-config.radius_error, config.radius_error));
  lever_m_ = (config.half_wheelbase_m + config.half_track_m) *
             (1 + rng_.Uniform(-config.lever_error, config.lever_error));
  lateral_loss_ = rng_.Uniform(0, config.lateral_loss);
  for (auto& slip : slip_) slip = rng_.Normal(config.roller_slip);
}

Twist2 MecanumBase::Step(const PerWheel& speed_rad_s, double dt_s) {
  PerWheel contact_m_s;
  for (std::size_t i = 0; i < 4; ++i) {
    const double rolled = radius_m_[i] * speed_rad_s[i];
    const double acceleration = (rolled - previous_m_s_[i]) / dt_s;
    previous_m_s_[i] = rolled;
    // Ornstein-Uhlenbeck process over the distance, not over time: a wheel at rest keeps its contact.
    const double travel = std::min(std::abs(rolled) * dt_s / config_.slip_length_m, 1.0);
    slip_[i] += -slip_[i] * travel + config_.roller_slip * std::sqrt(2 * travel) * rng_.Normal(1);
    const double driven_slip = config_.acceleration_slip_s2_m * acceleration * (rolled < 0 ? -1 : 1);
    contact_m_s[i] = rolled * (1 - slip_[i] - driven_slip);
  }
  RollLoose(dt_s, contact_m_s);
  const auto& c = contact_m_s;
  Twist2 twist;
  twist.vx = (c[0] + c[1] + c[2] + c[3]) / 4;
  twist.vy = (-c[0] + c[1] + c[2] - c[3]) / 4 * (1 - lateral_loss_);
  twist.wz = (-c[0] + c[1] - c[2] + c[3]) / (4 * lever_m_);
  twist_ = twist;
  return twist;
}

/// Three driven wheels lead the base, and the fourth follows. Fewer leave it free in some direction: there it
/// rolls on as it moved.
void MecanumBase::RollLoose(double dt_s, PerWheel& contact_m_s) {
  const bool is_led = std::count(loose_.begin(), loose_.end(), true) <= 1;
  const PerWheel coasting = ContactSpeeds(twist_);
  const double keeps = std::max(0.0, 1 - dt_s / kCoast_s);
  for (std::size_t i = 0; i < 4; ++i)
    if (loose_[i])
      contact_m_s[i] = previous_m_s_[i] = is_led ? FreeRolling(contact_m_s, i) : keeps * coasting[i];
}

PerWheel MecanumBase::ContactSpeeds(const Twist2& twist) const {
  const double turn = lever_m_ * twist.wz;
  return {twist.vx - twist.vy - turn, twist.vx + twist.vy + turn, twist.vx + twist.vy - turn,
          twist.vx - twist.vy + turn};
}

}  // namespace priamos::world
