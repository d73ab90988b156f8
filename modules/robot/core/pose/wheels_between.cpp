#include "robot/core/pose/wheels_between.hpp"

namespace priamos::robot {

void WheelsBetween::Add(const OdometryStep& step) {
  const double forward = step.twist.vx * step.seconds(), kept = step.wander.kept,
               added = step.wander.variance(1);
  usable_ = usable_ && step.known;
  turn_rad_ += step.twist.wz * step.seconds();
  forward_m_ += forward;
  if (!begun_ && kept < 1) {
    slip_ = added / (1 - kept * kept);
    begun_ = true;
  }
  variance_ += 2 * with_turn_ * forward + slip_ * forward * forward + step.noise(2, 2);
  with_turn_ = (with_turn_ + slip_ * forward) * kept;
  slip_ = slip_ * kept * kept + added;
}

}  // namespace priamos::robot
