#pragma once

#include <vector>

#include "planner/core/path/narrow_passages.hpp"
#include "planner/core/path/swept_footprint.hpp"

namespace priamos::planner {

/// The straight line on which a base drives through a narrow passage, ahead, from where its whole body is
/// before it to where its whole body is behind it, and a bit farther where there is room. Both poses have the
/// heading of the line.
struct PassageLane {
  Pose2 before, behind;
  NarrowPassage passage;
};

/// Both ways through each passage whose line is free with that margin.
std::vector<PassageLane> LanesThrough(const std::vector<NarrowPassage>& passages, const SweptFootprint& space,
                                      double margin_m);

}  // namespace priamos::planner
