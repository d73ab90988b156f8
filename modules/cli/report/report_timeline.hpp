#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/report/report_record.hpp"
#include "common/geometry.hpp"

namespace priamos::cli {

/// Where the robot truly was at `utime`, between two truth messages; nullopt outside the record.
std::optional<Pose2> TruthAt(const RunRecord& record, std::int64_t utime);

/// Moves a place of the true map to where the robot had it at `utime`; nullopt outside the record.
std::optional<Pose2> BeliefFromTruth(const RunRecord& record, std::int64_t utime);

/// Error of the robot's pose estimate at one time.
struct PoseError {
  std::int64_t utime = 0;
  double position_m = 0;   ///< distance, never negative
  double heading_rad = 0;  ///< believed minus true
};

/// The error of one pose estimate against the truth at the same time; nullopt outside the record.
std::optional<PoseError> ErrorOf(const RunRecord& record, const pose_t& pose);

/// The first passage of the base centre through the plane of a door, in the door's frame.
struct Crossing {
  std::int64_t utime = 0;
  double lateral_m = 0;    ///< true y in the door's frame, positive left of the middle
  double heading_rad = 0;  ///< true heading against the door's axis
};
std::optional<Crossing> CrossingOf(const RunRecord& record, const Pose2& map_from_door);

/// Time span from the order to the first DONE or FAILED; the whole record as far as these are missing.
struct MissionSpan {
  std::int64_t begin_utime = 0, end_utime = 0;
  bool done = false;
};
MissionSpan SpanOf(const RunRecord& record);

/// Time span from a look request to the pose correction that it led to.
struct LookSpan {
  std::int64_t begin_utime = 0, end_utime = 0;
  int side = 0;  ///< look_request_t::side
  pose_correction_t correction{};
};
/// Applied corrections only, in time order.
std::vector<LookSpan> LooksOf(const RunRecord& record);

}  // namespace priamos::cli
