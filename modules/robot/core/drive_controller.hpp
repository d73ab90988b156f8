#pragma once

#include <optional>

#include "common/config.hpp"
#include "common/time.hpp"
#include "robot/core/collision_stop.hpp"
#include "robot/core/echo_memory.hpp"
#include "robot/core/failsafe.hpp"
#include "robot/core/mecanum.hpp"
#include "robot/core/path_follower.hpp"
#include "robot/core/pose_estimator.hpp"
#include "robot/core/twist_slew.hpp"

namespace priamos::robot {

struct DriveConfig {
  Footprint footprint;
  PathFollowerConfig follower;
  AccelerationLimits acceleration;
  AccelerationLimits braking{.acceleration_m_s2 = 1.0, .turn_acceleration_rad_s2 = 2.0};
  EchoMemoryConfig echoes;
  CollisionStopConfig collision;
  FailsafeConfig failsafe;
  double lost_position_m = 0.5;  ///< sigma beyond which no path is driven
  double lost_yaw_deg = 12;
  double blocked_s = 0.5;

  void Describe(Archive& a);
};

enum class DriveMode { kIdle, kFollowing, kArrived, kHolding, kBlocked };

/// What the base knows about itself at one tick.
struct DriveSituation {
  std::optional<PoseEstimate> estimate;
  Pose2 odom_from_base;
  std::optional<Time> wheels_heard;  ///< newest credible encoder sample
};

struct DriveState {
  DriveMode mode = DriveMode::kIdle;
  FailsafeDecision failsafe;
  bool slowed_by_sonar = false;
  int path_id = 0;  ///< 0 before the first path
  double remaining_m = 0;
  double cross_track_m = 0;
  std::optional<double> nearest_m;  ///< free way to the nearest echo in driving direction
};

/// Turns paths into wheel speeds, through the chain that nothing bypasses:
///
///     path follower -> failsafe (hold, halt) -> acceleration limits -> collision stop -> wheels
///
/// Silent until the first path; from then on it gives wheel speeds at every step, zeros while standing, so
/// that the drive board's own dead-line is a second line of defence and not the normal way to stop.
class DriveController {
 public:
  DriveController(const DriveConfig& config, const MecanumGeometry& geometry);

  /// Replaces the path being driven; one without points brakes and holds. The very path that is being driven
  /// is ignored: a repeated message must not lead the base back to points it has passed.
  void SetPath(const Path& path);
  /// `odom_from_base` when the cycle ended.
  void AddSonar(const SonarCycle& cycle, const Pose2& odom_from_base) { echoes_.Add(cycle, odom_from_base); }

  /// Wheel speeds for now; nullopt while nothing was ever commanded.
  std::optional<WheelSpeeds> Step(const DriveSituation& situation, Time now);
  const DriveState& state() const { return state_; }

 private:
  FailsafeDecision Watch(const DriveSituation& situation, Time now);
  bool IsLost(const DriveSituation& situation) const;
  Twist2 WantedByPath(const DriveSituation& situation, Time now, double dt_s);
  Twist2 Guard(const Twist2& smooth, const DriveSituation& situation);
  void NoteBlocked(const Twist2& wanted, const Twist2& given, Time now);
  void NoteStuck(const DriveSituation& situation, Time now);
  void Halt();

  DriveConfig config_;
  MecanumGeometry geometry_;
  PathFollower follower_;
  TwistSlew slew_, brake_;
  EchoMemory echoes_;
  CollisionStop collision_;
  Failsafe failsafe_;
  DriveState state_;
  std::optional<Path> path_;  ///< the newest order
  bool path_is_new_ = false;  ///< not yet given to the follower
  std::optional<Time> last_step_, first_step_, sonar_heard_;
  std::optional<Time> pose_lost_since_, blocked_since_, stuck_since_;
};

}  // namespace priamos::robot
