#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// The walls without the pieces that the base has driven through, `half_width_m` to either side of where its
/// centre crossed them. A wall is told longer than it is when an echo of something behind an opening lies on
/// its line, and the pose drifts between the wall and the opening: where the base was, no wall is. What is
/// left of a wall keeps its number. `trail`: places of the base centre in turn, map frame.
LearnedWalls WithoutPassages(const LearnedWalls& walls, const std::vector<Eigen::Vector2d>& trail,
                             double half_width_m);

/// The walls as far as they surely reach: without two standard deviations at either end, 20 cm at most, and
/// without what is shorter than half a metre then. For ways through openings: a wall that is told a hand too
/// long closes one that the base could pass, and beside an edge, which is heard on an arc, a short piece is
/// told that is none.
LearnedWalls SureParts(const LearnedWalls& walls);

}  // namespace priamos::planner
