#include "world/core/head/mast.hpp"

namespace priamos::world {

void Mast::Step(const Twist2& velocity, double dt_s) {
  if (plan_.nod_deg_s2_m == 0) return;
  const double per_acceleration = Radians(plan_.nod_deg_s2_m);
  const double ahead_m_s2 = (velocity.vx - before_.vx) / dt_s, left_m_s2 = (velocity.vy - before_.vy) / dt_s;
  before_ = velocity;
  Step(pitch_, -per_acceleration * ahead_m_s2, dt_s);
  Step(roll_, per_acceleration * left_m_s2, dt_s);
}

/// Semi-implicit Euler: stable at these steps, and it neither gains nor loses energy by itself.
void Mast::Step(Swing& swing, double rest_rad, double dt_s) const {
  const double omega = 2 * kPi * plan_.frequency_hz;
  const double acceleration =
      omega * omega * (rest_rad - swing.at_rad) - 2 * plan_.damping * omega * swing.rate_rad_s;
  swing.rate_rad_s += acceleration * dt_s;
  swing.at_rad += swing.rate_rad_s * dt_s;
}

}  // namespace priamos::world
