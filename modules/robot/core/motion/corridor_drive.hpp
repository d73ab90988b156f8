#pragma once

#include <optional>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/motion/corridor_axis.hpp"
#include "robot/core/motion/path_follower.hpp"
#include "robot/core/motion/yield.hpp"
#include "robot/core/sonar/mover_watch.hpp"

namespace priamos::robot {

/// Leads a path along a corridor: in the middle between the walls that are heard, and out of the way of who
/// comes.
class CorridorDrive {
 public:
  CorridorDrive(const CorridorConfig& corridor, const YieldConfig& yield, const Footprint& footprint)
      : config_(corridor), footprint_(footprint), guide_(corridor), yield_(yield) {}

  /// Takes a wall that was found, or has grown; `number` names it.
  void Note(int number, const WallPiece& piece) { guide_.Note(number, piece); }
  /// Begins a corridor that runs in the direction `yaw_rad` [frame of the odometry].
  void Begin(const Pose2& odom_from_base, double yaw_rad);
  /// Whether the walls are to be looked at again.
  bool IsDue(Time now) const;
  /// What is left of `ordered` between the walls as they are heard now, `to_go_m` along the corridor.
  CentredPath Centred(const Path& ordered, const Pose2& map_from_base, const Pose2& odom_from_base,
                      double to_go_m, Time now);
  /// Velocity in place of `wanted` while somebody comes or stands near; nullopt: drive on.
  std::optional<Twist2> MakeRoom(const MoverWatch& movers, const PathFollower::Wanted& wanted,
                                 const Pose2& odom_from_base, Time now);

 private:
  std::optional<Comer> ComerAhead(const MoverWatch& movers, const Pose2& odom_from_base) const;

  CorridorConfig config_;
  Footprint footprint_;
  CorridorGuide guide_;
  Yield yield_;
  double room_m_ = 0;              ///< that the corridor leaves beside its middle
  std::optional<Time> looked_at_;  ///< when the walls were looked at last
};

}  // namespace priamos::robot
