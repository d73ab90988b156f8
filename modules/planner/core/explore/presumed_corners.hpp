#pragma once

#include <vector>

#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// The pieces that are missing between walls that would meet in the corner of a room. A wall is told as far
/// as the base heard it, which is never all the way into a corner. Only pieces up to `most_m` are presumed:
/// what leads through a shorter one is too narrow for the base.
std::vector<LearnedWall> PresumedCorners(const LearnedWalls& walls, double most_m);

}  // namespace priamos::planner
