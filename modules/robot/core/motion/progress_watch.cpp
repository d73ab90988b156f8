#include "robot/core/motion/progress_watch.hpp"

#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kMoved_m = 0.1, kTurned_rad = 0.15;

bool HasMoved(const Pose2& from, const Pose2& to) {
  return (to.translation() - from.translation()).norm() > kMoved_m ||
         std::abs(WrapAngle(to.yaw - from.yaw)) > kTurned_rad;
}

}  // namespace

void ProgressWatch::Reset() {
  anchor_.reset();
  nearest_.reset();
}

bool ProgressWatch::GetsNowhere(const Pose2& odom_from_base, double left_m, Time now) {
  if (!anchor_ || HasMoved(anchor_->pose, odom_from_base)) anchor_ = Anchor{odom_from_base, now};
  if (!nearest_ || left_m < nearest_->left_m - kMoved_m) nearest_ = Nearest{left_m, now};
  return now - anchor_->since > limits_.stays || now - nearest_->since > limits_.no_nearer;
}

}  // namespace priamos::robot
