#pragma once

#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

/// What is left of `path` for a base that stands at `map_from_base` on it or beside it: the points before it
/// with their leeway, at least the last one. The path began at `start`; the robot reported last to have
/// `remaining_m` of it before it, and may have come farther since. A path without points has none left.
PathOrder RemainderOf(const PathOrder& path, const Pose2& start, double remaining_m,
                      const Pose2& map_from_base);

}  // namespace priamos::planner
