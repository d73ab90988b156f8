#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "planner/core/door_landmark.hpp"

/// What a mission hears and says. Everything it hears from the robot has crossed a slow radio: stamps are the
/// times of the events, in the planner's clock, and lie some hundred milliseconds back.
namespace priamos::planner {

struct RobotPose {
  Time stamp;
  Pose2 map_from_base;
  Twist2 velocity;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< map: x, y, yaw
};

enum class DriveMode { kIdle, kFollowing, kArrived, kHolding, kBlocked };

struct DriveReport {
  DriveMode mode = DriveMode::kIdle;
  int path_id = 0;
  std::string limit;   ///< what limits the speed, in words; empty when nothing does
  bool estop = false;  ///< the emergency stop is latched
};

/// What became of a look: from the head (not found) or from the robot (applied or refused).
struct LookResult {
  int request_id = 0;
  bool ok = false;
  std::string reason;     ///< in words when not ok
  bool no_model = false;  ///< the head does not know the landmark (it was restarted)
};

struct PathOrder {
  int path_id = 0;
  double speed_m_s = 0;
  std::vector<Pose2> points;  ///< none: brake and hold
};

struct LookOrder {
  int request_id = 0;
  int landmark_id = 0;
  Side side = Side::kBoth;
};

/// What is to be sent now, in this order.
struct MissionActions {
  std::optional<Landmark> model;
  std::optional<PathOrder> path;
  std::optional<LookOrder> look;
};

enum class Phase { kWaiting, kApproaching, kLookingLeft, kLookingRight, kPassing, kDone, kFailed };

struct MissionState {
  Phase phase = Phase::kWaiting;
  std::string text = "no order yet";

  bool operator==(const MissionState&) const = default;
};

}  // namespace priamos::planner
