#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/robot/leeway.hpp"
#include "common/time.hpp"
#include "planner/core/map/door_landmark.hpp"
#include "planner/core/map/learned_map.hpp"
#include "planner/core/map/wall_faces.hpp"
#include "planner/core/path/planned_path.hpp"

/// Inputs and outputs of a mission. Everything it receives from the robot has crossed a slow radio: stamps
/// are the times of the events, in the planner's clock, and lie some hundred milliseconds back.
namespace priamos::planner {

/// An operator's order to carry out a mission.
struct MissionOrder {
  int kind = 0;           ///< index of the mission in the mission table
  int landmark_id = 0;    ///< landmark of the map that the mission concerns
  Goal goal{};            ///< place that it leads to
  double distance_m = 0;  ///< how far a corridor is followed; 0: to its end
};

/// Where the robot was at `stamp` and how it moved (base frame), as in POSE.
struct RobotPose {
  Time stamp;
  Pose2 map_from_base;
  Twist2 velocity;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of (x, y, yaw), map frame [m, rad]
};

/// A pose older than this is not planned with.
inline constexpr double kFreshPose_s = 1.0;

/// Whether a pose is young enough to be planned with.
inline bool IsFresh(const RobotPose& pose, Time now) {
  return Seconds(now - pose.stamp) <= kFreshPose_s;
}

/// State of the base; kHolding: ordered to stand, kBlocked: an obstacle stops it.
enum class DriveMode { kIdle, kFollowing, kArrived, kHolding, kBlocked };

/// What the base would meet first if it drove on.
struct ThingNear {
  double free_m = 0;            ///< until then
  Eigen::Vector2d at = {0, 0};  ///< base frame, as it stands now
};

/// Progress of the robot on its path, as in DRIVE_STATUS; path_id is 0 before the first one.
struct DriveReport {
  DriveMode mode = DriveMode::kIdle;
  int path_id = 0;
  std::string limit;                   ///< what limits the speed, in words; empty when nothing does
  bool estop = false;                  ///< the emergency stop is latched
  int estop_changes = 0;               ///< how often it was latched or lifted, modulo 256
  bool touched = false;                ///< the last motion ended because the base touched something
  double remaining_m = 0;              ///< distance left on the path
  std::optional<ThingNear> nearest{};  ///< if there is an echo in the direction of driving
  bool by_hand = false;                ///< an operator has the lease: no path is driven
  bool by_echo = false;                ///< it is an echo that limits the speed
};

/// A narrow opening that the robot drove through, by its sonars: evidence that does not rest on its pose
/// alone.
struct PassedOpening {
  Time stamp;           ///< when its middle was in the opening
  Pose2 map_from_base;  ///< where it believed to be then
  double width_m = 0;   ///< at most
};

/// What one look showed of a door's leaf.
struct LeafSighting {
  Time stamp;  ///< exposure
  int landmark_id = 0;
  std::string hinge;  ///< "left" or "right"; empty: the look showed no leaf
  double open_rad = 0, sigma_rad = 0;
  double log_odds = 0;  ///< of this leaf against other things
};

/// Outcome of a look: from the head (not found) or from the robot (applied or refused).
struct LookResult {
  int request_id = 0;
  bool ok = false;
  std::string reason{};      ///< in words when not ok
  bool no_model = false;     ///< the head does not know the landmark (it was restarted)
  bool implausible = false;  ///< the landmark was found where, by the robot's pose, it cannot be
  bool placed = false;       ///< not of a look: the robot has set its pose as it was told
  bool elsewhere = false;    ///< the head found the landmark where, by the pose's covariance, it cannot be
};

/// A path for the robot, map frame; driven at `speed_m_s`.
struct PathOrder {
  int path_id = 0;
  double speed_m_s = 0;
  std::vector<Pose2> points;     ///< none: brake and hold
  std::vector<Leeway> leeway{};  ///< of the line to each point; missing ones are 0
  int estop_changes = 0;         ///< DriveReport::estop_changes when the mission was ordered
  bool centre = false;           ///< keep to the middle between the walls that are heard; of one point
};

/// A look that the head is to take.
struct LookOrder {
  int request_id = 0;
  int landmark_id = 0;
  Side side = Side::kBoth;
};

/// Where the robot is told to be, map frame, and how well that is known.
struct PlaceOrder {
  int request_id = 0;
  Pose2 map_from_base;
  double sigma_m = 0.1, sigma_yaw_rad = 0.05;
};

/// What is to be sent now, in this order.
struct MissionActions {
  std::optional<Landmark> model;
  std::optional<std::vector<WallFace>>
      faces{};  ///< walls of the plan along the path; none: forget those before
  std::optional<PathOrder> path;
  std::optional<LookOrder> look;
  std::optional<PlaceOrder> place{};
  std::optional<LearnedWalls> map{};  ///< takes the place of the learned map; stays on the workstation
};

/// How far a mission has come; kDone and kFailed are its ends.
enum class Phase {
  kWaiting,
  kApproaching,
  kLookingLeft,
  kLookingRight,
  kPassing,
  kRetreating,
  kDriving,
  kDone,
  kFailed
};

/// Why the robot stands on its path and does not go on by itself.
struct Stop {
  /// What stopped it: an obstacle before it, something that it touched, or a pose too uncertain to go on.
  enum class Cause { kBlocked, kTouched, kUncertain };
  Cause cause = Cause::kBlocked;
  std::string reason;  ///< a sentence
};

/// Phase of the mission, and a sentence for a person.
struct MissionState {
  Phase phase = Phase::kWaiting;
  std::string text = "no order yet";

  bool operator==(const MissionState&) const = default;
};

}  // namespace priamos::planner
