#pragma once

#include <optional>
#include <string_view>

#include "lcmtypes/channels.hpp"
#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

RobotPose FromMessage(const pose_t& message);
DriveReport FromMessage(const drive_status_t& message);
PassedOpening FromMessage(const opening_t& message);
LeafSighting FromMessage(const door_seen_t& message);

/// What follows for a look from its fix alone: nothing yet when the landmark was found, because only the
/// robot knows whether the pose could be corrected with it; a failure otherwise.
std::optional<LookResult> FromMessage(const landmark_fix_t& message);
/// The outcome of a look from the correction of the pose.
LookResult FromMessage(const pose_correction_t& message);

/// A landmark as a message, which holds at most 20 edges; a path holds at most 16 points. The core makes
/// fewer.
landmark_model_t ToMessage(const Landmark& landmark);
path_t ToMessage(const PathOrder& path, Time now);
/// `sigma_m`: how well the plan knows the ends of its walls, across them.
plan_walls_t ToMessage(const std::vector<WallFace>& faces, double sigma_m);
look_request_t ToMessage(const LookOrder& look, Time now);
pose_reset_t ToMessage(const PlaceOrder& place, Time now);

/// The words that a person reads for a verdict or limit.
std::string_view FixVerdictText(int verdict);
std::string_view CorrectionVerdictText(int verdict);
std::string_view DriveLimitText(int limit);

}  // namespace priamos::planner
