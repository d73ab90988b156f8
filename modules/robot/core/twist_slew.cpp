#include "robot/core/twist_slew.hpp"

#include <algorithm>

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
  Eigen::Vector2d change = Eigen::Vector2d(target.vx, target.vy) - before;
  const double most = limits_.acceleration_m_s2 * dt_s;
  if (change.norm() > most) change *= most / change.norm();
  const double most_turn = limits_.turn_acceleration_rad_s2 * dt_s;
  commanded_ = {before.x() + change.x(), before.y() + change.y(),
                commanded_.wz + std::clamp(target.wz - commanded_.wz, -most_turn, most_turn)};
  return commanded_;
}

}  // namespace priamos::robot
