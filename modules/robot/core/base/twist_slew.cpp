#include "robot/core/base/twist_slew.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {

void AccelerationLimits::Describe(Archive& a) {
  a.Number("acceleration_m_s2", acceleration_m_s2, {"m/s^2", 0.05, 3, "change of the velocity"});
  a.Number("turn_acceleration_rad_s2", turn_acceleration_rad_s2,
           {"rad/s^2", 0.05, 10, "change of the turn rate"});
}

Twist2 TwistSlew::Step(const Twist2& target, double dt_s) {
  // The same velocity over the floor, seen from the base after it has turned for dt.
  const Eigen::Vector2d before =
      Pose2{0, 0, -commanded_.wz * dt_s} * Eigen::Vector2d(commanded_.vx, commanded_.vy);
  const Eigen::Vector2d change = Eigen::Vector2d(target.vx, target.vy) - before;
  const double turn_change = target.wz - commanded_.wz;
  const auto share = [](double wanted, double most) { return wanted > most ? most / wanted : 1; };
  const double part = std::min(share(change.norm(), limits_.acceleration_m_s2 * dt_s),
                               share(std::abs(turn_change), limits_.turn_acceleration_rad_s2 * dt_s));
  commanded_ = {before.x() + part * change.x(), before.y() + part * change.y(),
                commanded_.wz + part * turn_change};
  return commanded_;
}

}  // namespace priamos::robot
