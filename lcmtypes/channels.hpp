#pragma once

#include <tuple>

#include "lcmtypes/channel.hpp"
#include "priamos/alarm_ack_t.hpp"
#include "priamos/alarm_t.hpp"
#include "priamos/bumper_t.hpp"
#include "priamos/camera_frame_t.hpp"
#include "priamos/camera_trigger_t.hpp"
#include "priamos/claim_t.hpp"
#include "priamos/clock_report_t.hpp"
#include "priamos/door_found_t.hpp"
#include "priamos/door_seen_t.hpp"
#include "priamos/drive_command_t.hpp"
#include "priamos/drive_status_t.hpp"
#include "priamos/estop_t.hpp"
#include "priamos/features_ack_t.hpp"
#include "priamos/features_t.hpp"
#include "priamos/floor_map_t.hpp"
#include "priamos/head_aim_t.hpp"
#include "priamos/head_command_t.hpp"
#include "priamos/head_drive_t.hpp"
#include "priamos/head_state_t.hpp"
#include "priamos/health_t.hpp"
#include "priamos/landmark_fix_t.hpp"
#include "priamos/landmark_model_t.hpp"
#include "priamos/landmark_view_t.hpp"
#include "priamos/lease_request_t.hpp"
#include "priamos/link_request_t.hpp"
#include "priamos/link_status_t.hpp"
#include "priamos/look_request_t.hpp"
#include "priamos/map_command_t.hpp"
#include "priamos/mission_command_t.hpp"
#include "priamos/mission_status_t.hpp"
#include "priamos/motor_current_t.hpp"
#include "priamos/obstacle_line_t.hpp"
#include "priamos/odometry_t.hpp"
#include "priamos/opening_t.hpp"
#include "priamos/parameter_order_t.hpp"
#include "priamos/parameter_value_t.hpp"
#include "priamos/path_t.hpp"
#include "priamos/plan_walls_t.hpp"
#include "priamos/pose_correction_t.hpp"
#include "priamos/pose_reset_t.hpp"
#include "priamos/pose_t.hpp"
#include "priamos/probe_t.hpp"
#include "priamos/process_order_t.hpp"
#include "priamos/process_report_t.hpp"
#include "priamos/process_state_t.hpp"
#include "priamos/scene_object_t.hpp"
#include "priamos/simulation_t.hpp"
#include "priamos/sonar_ranges_t.hpp"
#include "priamos/wheel_command_t.hpp"
#include "priamos/wheel_state_t.hpp"
#include "priamos/world_touch_t.hpp"
#include "priamos/world_truth_t.hpp"

/// Every channel of PRIAMOS. Device channels join drivers (or `world`) with `robot` and `head`; the others
/// join processes wherever they run, across Ethernet or radio.
namespace priamos::channels {

using std::chrono::milliseconds;

// Device channels, onboard only.
inline constexpr Channel<wheel_command_t> kWheelCommand{"WHEEL_COMMAND", 50, milliseconds(200)};
inline constexpr Channel<wheel_state_t> kWheelState{"WHEEL_STATE", 50, milliseconds(200)};
inline constexpr Channel<motor_current_t> kMotorCurrent{"MOTOR_CURRENT", 50, milliseconds(200)};
inline constexpr Channel<bumper_t> kBumper{"BUMPER", 50, milliseconds(200)};
inline constexpr Channel<sonar_ranges_t> kSonarRanges{"SONAR_RANGES", 10, milliseconds(500)};
inline constexpr Channel<head_command_t> kHeadCommand{"HEAD_COMMAND", 0, milliseconds(0)};
inline constexpr Channel<head_state_t> kHeadState{"HEAD_STATE", 50, milliseconds(200)};
inline constexpr Channel<camera_trigger_t> kCameraTrigger{"CAMERA_TRIGGER", 0, milliseconds(0)};
inline constexpr Channel<camera_frame_t> kCameraFrame{"CAMERA_FRAME", 0, milliseconds(0)};

// Pose and driving.
inline constexpr Channel<odometry_t> kOdometry{"ODOMETRY", 50, milliseconds(200)};
inline constexpr Channel<pose_t> kPose{"POSE", 50, milliseconds(1000)};
inline constexpr Channel<path_t> kPath{"PATH", 0, milliseconds(0)};
inline constexpr Channel<plan_walls_t> kPlanWalls{"PLAN_WALLS", 0, milliseconds(0)};
inline constexpr Channel<drive_status_t> kDriveStatus{"DRIVE_STATUS", 10, milliseconds(2000)};
inline constexpr Channel<opening_t> kOpening{"OPENING", 1, milliseconds(3000)};
inline constexpr Channel<pose_correction_t> kPoseCorrection{"POSE_CORRECTION", 0, milliseconds(0)};
inline constexpr Channel<pose_reset_t> kPoseReset{"POSE_RESET", 0, milliseconds(0)};

// Driving by hand.
inline constexpr Channel<drive_command_t> kDriveCommand{"DRIVE_COMMAND", 20, milliseconds(250)};
inline constexpr Channel<head_drive_t> kHeadDrive{"HEAD_DRIVE", 10, milliseconds(500)};
inline constexpr Channel<head_aim_t> kHeadAim{"HEAD_AIM", 0, milliseconds(0)};
inline constexpr Channel<lease_request_t> kLeaseRequest{"LEASE_REQUEST", 0, milliseconds(0)};
inline constexpr Channel<estop_t> kEstop{.name = "ESTOP",
                                         .safety_act = [](const estop_t& order) { return order.action; }};

// Seeing.
inline constexpr Channel<landmark_model_t> kLandmarkModel{"LANDMARK_MODEL", 0, milliseconds(0)};
inline constexpr Channel<look_request_t> kLookRequest{"LOOK_REQUEST", 0, milliseconds(0)};
inline constexpr Channel<landmark_fix_t> kLandmarkFix{"LANDMARK_FIX", 0, milliseconds(0)};
inline constexpr Channel<door_seen_t> kDoorSeen{"DOOR_SEEN", 0, milliseconds(0)};
inline constexpr Channel<door_found_t> kDoorFound{"DOOR_FOUND", 0, milliseconds(0)};
inline constexpr Channel<scene_object_t> kSceneObject{"SCENE_OBJECT", 0, milliseconds(0)};
inline constexpr Channel<landmark_view_t> kLandmarkView{"LANDMARK_VIEW", 0, milliseconds(0)};
inline constexpr Channel<obstacle_line_t> kObstacleLine{"OBSTACLE_LINE", 5, milliseconds(1000)};
inline constexpr Channel<features_t> kFeatures{"FEATURES", 0, milliseconds(0)};
inline constexpr Channel<features_ack_t> kFeaturesAck{"FEATURES_ACK", 0, milliseconds(0)};

// Missions, offboard.
inline constexpr Channel<mission_command_t> kMissionCommand{"MISSION_COMMAND", 0, milliseconds(0)};
inline constexpr Channel<mission_status_t> kMissionStatus{"MISSION_STATUS", 2, milliseconds(2000)};
inline constexpr Channel<map_command_t> kMapCommand{"MAP_COMMAND", 0, milliseconds(0)};
inline constexpr Channel<floor_map_t> kFloorMap{"FLOOR_MAP", 0, milliseconds(0)};

// Every process, every bus.
inline constexpr Channel<health_t> kHealth{"HEALTH", 1, milliseconds(3000)};
inline constexpr Channel<link_status_t> kLinkStatus{"LINK_STATUS", 1, milliseconds(3000)};
inline constexpr Channel<link_request_t> kLinkRequest{"LINK_REQUEST", 0, milliseconds(0)};
inline constexpr Channel<parameter_order_t> kParameterOrder{"PARAMETER_ORDER", 0, milliseconds(0)};
inline constexpr Channel<parameter_value_t> kParameterValue{"PARAMETER_VALUE", 0, milliseconds(0)};
inline constexpr Channel<process_order_t> kProcessOrder{"PROCESS_ORDER", 0, milliseconds(0)};
inline constexpr Channel<process_report_t> kProcessReport{"PROCESS_REPORT", 0, milliseconds(0)};
inline constexpr Channel<process_state_t> kProcessState{"PROCESS_STATE", 1, milliseconds(3000)};
inline constexpr Channel<simulation_t> kSimulation{"SIMULATION", 1, milliseconds(3000)};
inline constexpr Channel<alarm_t> kAlarm{"ALARM", 0, milliseconds(0)};
inline constexpr Channel<alarm_ack_t> kAlarmAck{"ALARM_ACK", 0, milliseconds(0)};
inline constexpr Channel<claim_t> kClaim{"CLAIM", 5, milliseconds(1000)};
inline constexpr Channel<probe_t> kProbe{"PROBE", 0, milliseconds(0)};
inline constexpr Channel<clock_report_t> kClock{"CLOCK", 1, milliseconds(3000)};

/// For reports and tests; a test checks that no module subscribes to them.
inline constexpr Channel<world_truth_t> kWorldTruth{"WORLD_TRUTH", 50, milliseconds(200)};
inline constexpr Channel<world_touch_t> kWorldTouch{"WORLD_TOUCH", 0, milliseconds(0)};

inline constexpr std::tuple kAll{
    kWheelCommand,   kWheelState,   kSonarRanges,   kHeadCommand,    kHeadState,     kCameraTrigger,
    kCameraFrame,    kOdometry,     kPose,          kPath,           kDriveStatus,   kPoseCorrection,
    kLandmarkModel,  kLookRequest,  kLandmarkFix,   kMissionCommand, kMissionStatus, kHealth,
    kLinkStatus,     kWorldTruth,   kDriveCommand,  kHeadDrive,      kLeaseRequest,  kEstop,
    kLinkRequest,    kLandmarkView, kObstacleLine,  kAlarm,          kClaim,         kMotorCurrent,
    kBumper,         kOpening,      kDoorSeen,      kPoseReset,      kProbe,         kClock,
    kWorldTouch,     kFeatures,     kFeaturesAck,   kMapCommand,     kPlanWalls,     kParameterOrder,
    kParameterValue, kProcessOrder, kProcessReport, kProcessState,   kSimulation,    kAlarmAck,
    kFloorMap,       kHeadAim,      kDoorFound,     kSceneObject};

}  // namespace priamos::channels
