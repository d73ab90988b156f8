#pragma once

#include <vector>

#include "common/archive.hpp"
#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// How much may be missing of walls to the corner of a room.
struct CornerConfig {
  double most_m = 0.75;  ///< of either: through less the base does not fit
  double heard_m = 2.5;  ///< of either, where the corner itself was heard

  void Describe(Archive& a);
};

/// The pieces that are missing between walls that would meet in the corner of a room. A wall is told as far
/// as the base heard it, which is never all the way into a corner.
std::vector<LearnedWall> PresumedCorners(const LearnedWalls& walls, const CornerConfig& config);

}  // namespace priamos::planner
