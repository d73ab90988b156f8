#pragma once

#include <optional>

#include "head/core/doors/door_tracks.hpp"
#include "head/core/doors/leaf_sight.hpp"
#include "head/core/floor/obstacle_lines.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/landmark/landmark_view.hpp"
#include "head/core/landmark/pose_history.hpp"
#include "head/core/motion/head_aim.hpp"
#include "head/core/motion/head_jog.hpp"
#include "head/core/motion/head_positioner.hpp"
#include "head/core/motion/look_sequence.hpp"
#include "head/core/scene/scene_tracks.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::head {

/// What the planner wants to see.
struct LookOrder {
  std::int32_t request_id = 0;
  int landmark_id = 0;
  int side = 0;  ///< 0 whole, 1 left, 2 right

  bool operator==(const LookOrder&) const = default;
};

/// A fix with the order that it answers.
struct LookAnswer {
  LookOrder order;
  Time exposure;
  LandmarkFix fix;
  Pose2 map_from_landmark;        ///< pose of the landmark in its model, map frame
  LandmarkView view;              ///< edges that led to the verdict
  std::optional<LeafSight> leaf;  ///< leaf of the door found; nullopt: no door was found
  int n_third = 0;                ///< edges that the third camera added to the fix
};

HeadReport FromMessage(const head_state_t& message);
FrameNotice FromMessage(const camera_frame_t& message);
LookOrder FromMessage(const look_request_t& message);
HeadWish FromMessage(const head_drive_t& message);
HeadAim FromMessage(const head_aim_t& message);
/// Pose of the base; nullopt unless all numbers are finite.
std::optional<PoseSample> FromMessage(const pose_t& message);
/// Model of a landmark; nullopt unless all numbers are finite; edges without length are left out.
std::optional<LandmarkModel> FromMessage(const landmark_model_t& message);

head_command_t ToMessage(const HeadSetting& setting, Time now);
/// Order to expose `cameras`, given as bits: 1 left, 2 right, 4 third; 8 with the line laser on.
camera_trigger_t TriggerMessage(std::int32_t frame_id, int cameras, Time now);
landmark_fix_t ToMessage(const LookAnswer& answer);
/// What the look shows of the door's leaf; nullopt unless it found a door.
std::optional<door_seen_t> DoorSeenMessage(const LookAnswer& answer);
/// A door that was found, in the state `state`.
door_found_t ToMessage(const DoorTrack& door, DoorState state);
scene_object_t ToMessage(const SceneTrack& track, bool has_gone);
/// The view as a message; edges that do not fit it, the last ones, are left out and counted.
landmark_view_t ViewMessage(const LookAnswer& answer);
/// The pieces as a message; of those that do not fit, kMissing ones are left out first, then the lowest. They
/// are counted.
obstacle_line_t ToMessage(const ObstacleLines& lines, Time exposure);
/// The pieces in the message; those of unknown kind are left out.
ObstacleLines FromMessage(const obstacle_line_t& message);
/// The view in the message; edges of unknown kind are left out.
LandmarkView FromMessage(const landmark_view_t& message);

}  // namespace priamos::head
