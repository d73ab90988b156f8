#pragma once

#include <optional>
#include <string_view>

#include "lcmtypes/channels.hpp"
#include "robot/core/motion/drive_controller.hpp"
#include "robot/core/pose/localiser.hpp"
#include "robot/core/sonar/opening_watch.hpp"

namespace priamos::robot {

WheelSample FromMessage(const wheel_state_t& message);
/// Nullopt when a value is not a number.
std::optional<MotorCurrents> FromMessage(const motor_current_t& message);
SonarCycle FromMessage(const sonar_ranges_t& message);
/// Path in the map frame; nullopt if it cannot be driven: points that are not finite or outside the map's 100
/// m, or a speed that is not above 0 while there are points.
std::optional<Path> FromMessage(const path_t& message);
/// Walls of the plan; nullopt when a number is out of range.
std::optional<std::vector<PlanWall>> FromMessage(const plan_walls_t& message);
/// Fix from the head; nullopt unless it found the landmark. Numbers that make no sense become a fix that the
/// estimator refuses.
std::optional<LandmarkFix> FromMessage(const landmark_fix_t& message);
/// Obstacles seen by the line laser; nullopt if any number is not finite or outside its range. What is only
/// missing is no obstacle.
std::optional<FloorLine> FromMessage(const obstacle_line_t& message);
/// A thing that the head saw; nullopt if any number is not finite or outside its range.
std::optional<SeenThing> FromMessage(const scene_object_t& message);
DriveCommand FromMessage(const drive_command_t& message);
/// Request for the lease: who asks, and for what.
struct LeaseRequest {
  LeaseHolder who;
  Lease::Wish wish = Lease::Wish::kAcquire;
};
/// Request for the lease; nullopt for a driver or an action that does not exist.
std::optional<LeaseRequest> FromMessage(const lease_request_t& message);

/// Pose that a person knows; nullopt when a number is not finite or outside its range.
std::optional<KnownPose> FromMessage(const pose_reset_t& message);

/// Set values of the wheels as a message; `instance` names the process that commands.
wheel_command_t ToMessage(const WheelSpeeds& speeds, std::int32_t instance, Time now);
odometry_t ToMessage(const Odometry& odometry);
pose_t ToMessage(const PoseEstimate& estimate);
drive_status_t ToMessage(const DriveState& state, double speed_m_s, Time now);
/// What the robot made of a fix that it used, or refused.
pose_correction_t ToMessage(const Localiser::Answer& answer, Time now);
opening_t ToMessage(const Opening& opening);
/// What it made of one that the head could not give.
pose_correction_t NotFound(const landmark_fix_t& message, Time now);
/// The answer to an order to set the pose: `verdict` as in pose_correction_t, `change` of the pose.
pose_correction_t AnswerTo(const pose_reset_t& order, int verdict, const Pose2& change, Time now);

/// A condition in words, for logs and HEALTH.
std::string_view Text(Condition condition);
std::string_view Text(Driver driver);

}  // namespace priamos::robot
