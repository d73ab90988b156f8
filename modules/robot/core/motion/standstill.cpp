#include "robot/core/motion/standstill.hpp"

#include <cmath>

namespace priamos::robot {

Duration Standstill::Stays(const Pose2& odom_from_base, Time now) {
  constexpr double kMoved_m = 0.1, kTurned_rad = 0.15;
  const bool moved =
      anchor_ && ((odom_from_base.translation() - anchor_->pose.translation()).norm() > kMoved_m ||
                  std::abs(WrapAngle(odom_from_base.yaw - anchor_->pose.yaw)) > kTurned_rad);
  if (!anchor_ || moved) anchor_ = Anchor{odom_from_base, now};
  return now - anchor_->since;
}

}  // namespace priamos::robot
