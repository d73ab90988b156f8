#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/robot_drawing.hpp"
#include "common/time.hpp"
#include "robot/core/sonar/near_map.hpp"

namespace priamos::robot {

/// A straight piece of the laser's line that does not lie on the floor, base frame at the time of the
/// picture.
struct FloorPiece {
  Eigen::Vector2d right{0, 0}, left{0, 0};  ///< ends, as they lie
  double height_m = 0;                      ///< above the floor; below it negative: a step down
};

/// What one picture of the line showed.
struct FloorLine {
  Time exposure{};
  std::vector<FloorPiece> pieces;
};

/// Where the line laser sits (base frame), and how long its lines count.
struct FloorMemoryConfig {
  double laser_x_m = kDrawnLaser.x_m, laser_height_m = kDrawnLaser.z_m;
  double max_age_s = 1;   ///< largest age of a picture when it arrives
  double unseen_m = 0.3;  ///< the floor so far before the first line is unknown
  NearMapConfig kept{.keep_m = 1, .keep_s = 60, .keep_standing_s = 600, .forget_m = 4};

  void Describe(Archive& a);
};

/// Obstacles on the floor that are too low for the sonars, and steps down. The lines lie two and three metres
/// ahead and pass a place once, so a place is kept until the base is far from it or has driven about for a
/// minute. A thing begins somewhere between this line and the one before; the nearer end counts.
class FloorMemory {
 public:
  explicit FloorMemory(const FloorMemoryConfig& config) : config_(config), map_(config.kept) {}

  /// Adds a line of the laser. `odom_from_base`: pose at the time of the picture. Returns false if it is too
  /// old, from the future, or not newer than the one before.
  bool Add(const FloorLine& line, const Pose2& odom_from_base, Time now);
  void Forget(const Pose2& odom_from_base, Time now) { map_.Forget(odom_from_base, now); }
  /// The points that are kept, in the frame of `odom_from_base` [m].
  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const {
    return map_.Points(odom_from_base);
  }

 private:
  Eigen::Vector2d OnFloor(const Eigen::Vector2d& at, double height_m) const;

  FloorMemoryConfig config_;
  NearMap map_;
  std::optional<Time> last_;
  Pose2 odom_from_last_;
};

}  // namespace priamos::robot
