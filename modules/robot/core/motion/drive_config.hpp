#pragma once

#include "common/archive.hpp"
#include "robot/core/base/twist_slew.hpp"
#include "robot/core/motion/corridor_axis.hpp"
#include "robot/core/motion/meeting_stop.hpp"
#include "robot/core/motion/path_follower.hpp"
#include "robot/core/motion/yield.hpp"
#include "robot/core/safety/authority.hpp"
#include "robot/core/safety/collision_stop.hpp"
#include "robot/core/safety/failsafe.hpp"
#include "robot/core/safety/touch_watch.hpp"
#include "robot/core/sonar/approach_watch.hpp"
#include "robot/core/sonar/echo_memory.hpp"
#include "robot/core/sonar/floor_memory.hpp"
#include "robot/core/sonar/hanging_memory.hpp"
#include "robot/core/sonar/mover_watch.hpp"

namespace priamos::robot {

/// Everything that decides about motion: a section of `config/<deployment>/robot.toml`.
struct DriveConfig {
  Footprint footprint;
  PathFollowerConfig follower;
  CorridorConfig corridor;
  YieldConfig yield;
  AccelerationLimits acceleration;
  AccelerationLimits operator_acceleration{.acceleration_m_s2 = 0.8, .turn_acceleration_rad_s2 = 1.5};
  AccelerationLimits braking{.acceleration_m_s2 = 1.0, .turn_acceleration_rad_s2 = 2.0};
  EchoMemoryConfig echoes;
  FloorMemoryConfig floor;
  HangingConfig hanging;
  MoverConfig movers;
  ApproachConfig approach;
  MeetingStopConfig meeting;
  CollisionStopConfig collision;
  TouchConfig touch;
  double operator_margin_m =
      0.04;  ///< added to the margins of collision where nobody plans to the centimetre
  AuthorityConfig authority;
  FailsafeConfig failsafe;
  double lost_position_m = 0.5;  ///< sigma of the position beyond which no path is driven
  double lost_yaw_deg = 12;
  double blocked_s = 0.5;
  double waits_s = 3;          ///< standing on its way for so long: something closes the way
  double no_nearer_s = 10;     ///< moving for so long and no nearer to the end of the path: the same
  double fix_needed_m = 0.25;  ///< sigma beyond which a silent head matters

  void Describe(Archive& a);
};

}  // namespace priamos::robot
