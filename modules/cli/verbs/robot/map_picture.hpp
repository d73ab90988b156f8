#pragma once

#include "common/drawing/drawing.hpp"
#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"

namespace priamos::cli {

/// The surveyed plan, what was learned on top of it, each with two sigmas, and the gaps between.
drawing::Drawing DrawMap(const GroundPlan& plan, const LearnedWalls& learned);

}  // namespace priamos::cli
