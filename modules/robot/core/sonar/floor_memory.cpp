#include "robot/core/sonar/floor_memory.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kApart = 0.03;    // of the points of a piece [m]
constexpr double kFuture_s = 0.1;  // a picture of a time to come is somebody else's

}  // namespace

void FloorMemoryConfig::Describe(Archive& a) {
  a.Number("laser_x_m", laser_x_m, {"m", -2, 2, "where the fan of light begins, base frame"});
  a.Number("laser_height_m", laser_height_m,
           {"m", 0.05, 3, "height above the floor where the fan of light begins"});
  a.Number("max_age_s", max_age_s, {"s", 0.05, 5, "an older picture of the line is refused"});
  a.Number("unseen_m", unseen_m, {"m", 0, 2, "distance before the first line in which a thing may begin"});
  a.Section("kept", kept, "how long places are remembered");
}

/// A line on the ground of a hole has passed its edge on the level of the floor.
Eigen::Vector2d FloorMemory::OnFloor(const Eigen::Vector2d& at, double height_m) const {
  const Eigen::Vector2d laser(config_.laser_x_m, 0);
  const double depth = std::max(0.0, -height_m);
  return laser + (at - laser) * config_.laser_height_m / (config_.laser_height_m + depth);
}

bool FloorMemory::Add(const FloorLine& line, const Pose2& odom_from_base, Time now) {
  const double age_s = Seconds(now - line.exposure);
  if (!(age_s <= config_.max_age_s && age_s >= -kFuture_s) || (last_ && line.exposure <= *last_))
    return false;
  const double driven_m = (odom_from_base.translation() - odom_from_last_.translation()).norm();
  const double unseen_m = last_ ? std::min(driven_m, config_.unseen_m) : config_.unseen_m;
  last_ = line.exposure;
  odom_from_last_ = odom_from_base;
  for (const FloorPiece& piece : line.pieces) {
    const Eigen::Vector2d right = OnFloor(piece.right, piece.height_m),
                          left = OnFloor(piece.left, piece.height_m);
    const int n = 1 + static_cast<int>((left - right).norm() / kApart);
    for (int i = 0; i <= n; ++i) {
      const Eigen::Vector2d at = right + (left - right) * i / n;
      map_.Add(odom_from_base * Pose2{at.x() - unseen_m, at.y(), 0}, 0);
      map_.Add(odom_from_base * Pose2{at.x(), at.y(), 0}, 0);
    }
  }
  return true;
}

}  // namespace priamos::robot
