#pragma once

#include <optional>
#include <vector>

#include "common/time.hpp"
#include "robot/core/base/mecanum.hpp"
#include "robot/core/base/twist_slew.hpp"
#include "robot/core/motion/corridor_drive.hpp"
#include "robot/core/motion/deflection.hpp"
#include "robot/core/motion/drive_config.hpp"
#include "robot/core/motion/path_follower.hpp"
#include "robot/core/motion/progress_watch.hpp"
#include "robot/core/motion/surroundings.hpp"
#include "robot/core/pose/pose_estimator.hpp"
#include "robot/core/safety/authority.hpp"
#include "robot/core/safety/collision_stop.hpp"
#include "robot/core/safety/failsafe.hpp"
#include "robot/core/safety/touch_watch.hpp"

namespace priamos::robot {

/// State of the base; kHolding: ordered to stand, kBlocked: an obstacle stops it.
enum class DriveMode { kIdle, kFollowing, kArrived, kHolding, kBlocked, kOperated };

/// What the base knows about itself at one tick.
struct DriveSituation {
  std::optional<PoseEstimate> estimate;
  Pose2 odom_from_base;
  std::optional<Time> wheels_heard;  ///< newest credible encoder sample
  std::optional<Time> head_heard{};  ///< newest sign of life of the head
  /// How long the radio link has been down; 0 while it is up or nothing is known of it.
  Duration link_down{};
};

/// Result of an order to drive a path. Stale: who ordered it did not know of the newest e-stop or re-arming,
/// and after these nothing moves without a new order. Touched: the base has just touched something, of which
/// who ordered it cannot know yet.
enum class PathVerdict { kTaken, kSame, kWithoutLease, kEstop, kStale, kTouched };

/// What the base does at one tick and why, as DRIVE_STATUS reports it.
struct DriveState {
  DriveMode mode = DriveMode::kIdle;
  FailsafeDecision failsafe;
  std::optional<Condition> halted_by;  ///< what ended the last motion for good; until a new one begins
  std::optional<Touch> touch;          ///< newest touch that was noticed
  bool bumped = false;                 ///< somebody touches the standing base, or did so just now
  bool slowed_by_sonar = false;
  int path_id = 0;  ///< 0 before the first path
  double remaining_m = 0;
  double cross_track_m = 0;
  std::optional<CollisionStop::Nearest> nearest;  ///< the nearest echo in driving direction
  double allowed = 1;  ///< part of the wanted motion that sonars and failsafe leave
  LeaseHolder holder;
  bool estop = false;
  int estop_changes = 0;  ///< see Authority
  int refused_commands = 0;
  CommandVerdict refusal =
      CommandVerdict::kAccepted;  ///< verdict on the newest refused command; kAccepted: none yet
};

/// Turns paths and an operator's commands into wheel speeds, through the chain that nothing bypasses:
///
///     path follower, or operator
///         -> failsafe (hold, halt) -> acceleration limits -> deflection (operator) -> collision stop ->
///         wheels
///
/// Silent until the first order; from then on it gives wheel speeds at every step, zeros while standing, so
/// that the drive board's own dead-line is a second line of defence and not the normal stop.
class DriveController {
 public:
  DriveController(const DriveConfig& config, const MecanumGeometry& geometry);

  /// Takes over speeds, margins and times that may be changed while it drives: those that RobotConfig marks
  /// as live. What else differs in `config` is not looked at.
  void Reconfigure(const DriveConfig& config);

  /// Replaces the path being driven; one without points brakes and holds. The very path that is being driven
  /// is ignored: a repeated message must not lead the base back to points it has passed.
  PathVerdict SetPath(const Path& path, Time now);
  /// Forgets a path that has been driven, so that a new pose does not lead the base back to its end. False,
  /// and nothing is forgotten, while a path is being driven.
  bool ForgetDrivenPath();
  CommandVerdict SetCommand(const DriveCommand& command, Time now);
  Lease::Answer RequestLease(const LeaseHolder& who, Lease::Wish wish, Time now);
  void PressEstop() { authority_.PressEstop(); }
  void Rearm() { authority_.Rearm(); }
  bool estop() const { return authority_.estop(); }
  /// Sets the first number of e-stop changes, before the first step: see Authority.
  void CountEstopChangesFrom(Time start) { authority_.CountEstopChangesFrom(start); }
  /// Takes a line of the laser; returns false when FloorMemory refused it. `odom_from_base`: pose when the
  /// picture was taken.
  bool AddFloorLine(const FloorLine& line, const Pose2& odom_from_base, Time now) {
    return surroundings_.AddFloorLine(line, odom_from_base, now);
  }
  /// Takes a thing that the head saw. `odom_from_map`: as it is known now.
  void AddSeenThing(const SeenThing& thing, const Pose2& odom_from_map) {
    surroundings_.AddSeenThing(thing, odom_from_map);
  }
  /// Takes a cycle of the sonars. `odom_from_base`: pose when the cycle ended.
  void AddSonar(const SonarCycle& cycle, const Pose2& odom_from_base) {
    surroundings_.AddSonar(cycle, odom_from_base, HeedsMovers());
  }

  /// Takes a piece of wall that was found or has grown: a centred path is led by them.
  void AddWall(int number, const WallPiece& piece) { corridor_.Note(number, piece); }

  /// What shows touches: the bumper, motor currents, and the velocity by the encoders.
  TouchWatch& touch_watch() { return touch_; }

  /// Wheel speeds for now; nullopt while nothing was ever commanded.
  std::optional<WheelSpeeds> Step(const DriveSituation& situation, Time now);
  const DriveState& state() const { return state_; }

 private:
  const CollisionStop& Guard() const;
  bool IsRough() const;
  bool HasPathToGo() const;
  void DropPath();
  DriveSource Source(Time now) const;
  FailsafeDecision Watch(const DriveSituation& situation, Time now);
  bool IsLost(const DriveSituation& situation) const;
  Obstacles Around(const Pose2& odom_from_base) const;
  Twist2 Wanted(const DriveSituation& situation, const Obstacles& around, Time now, double dt_s);
  std::vector<Eigen::Vector2d> ThingsInMap(const DriveSituation& situation, const Obstacles& around,
                                           Time now) const;
  Twist2 WantedByPath(const DriveSituation& situation, const Obstacles& around, Time now, double dt_s);
  void BeginPath(const DriveSituation& situation);
  bool InCorridor() const;
  bool HeedsMovers() const;
  bool StandsForMover(const DriveSituation& situation, Time now);
  void KeepCentred(const DriveSituation& situation, Time now);
  void StandIfLetGo(Time now);
  Twist2 WantedByOperator(Time now) const;
  Twist2 FreeOf(const Twist2& motion, const Obstacles& around) const;
  Twist2 Slewed(const Twist2& wanted, double dt_s);
  void SetCommanded(const Twist2& twist);
  void NoteSonar(const Twist2& wanted, const Twist2& free, const Obstacles& around,
                 const CollisionStop::Result& result);
  void NoteBlocked(const Twist2& wanted, const Twist2& given, Time now);
  void NoteWaiting(const DriveSituation& situation, const Obstacles& around, Time now);
  void NoteTouch(const DriveSituation& situation, Time now);
  void NoteStuck(const DriveSituation& situation, Time now);
  void NoteEnd(DriveSource source);
  void Halt(Condition cause, const DriveSituation& situation, Time now);
  void StandAfterContact(Time now);

  DriveConfig config_;
  MecanumGeometry geometry_;
  PathFollower follower_;
  CorridorDrive corridor_;
  TwistSlew slew_, operator_slew_, brake_;
  Surroundings surroundings_;
  MeetingStop meeting_;
  ProgressWatch progress_;
  CollisionStop collision_, rough_collision_;
  TouchWatch touch_;
  Authority authority_;
  Failsafe failsafe_;
  DriveState state_;
  std::optional<Path> path_;  ///< the newest order
  bool path_is_new_ = false;  ///< not yet given to the follower
  bool ever_ordered_ = false;
  bool stands_for_comer_ = false;  ///< in the newest step
  std::optional<Time> last_step_, first_step_, sonar_heard_;
  std::optional<Time> pose_lost_since_, blocked_since_, stuck_since_;
  std::optional<Time> bumped_since_, bumped_;  ///< since when somebody who came touches the base; newest
};

}  // namespace priamos::robot
