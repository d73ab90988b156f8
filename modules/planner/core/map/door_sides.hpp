#pragma once

#include <vector>

#include "common/ground_plan.hpp"

namespace priamos::planner {

/// The door as who comes from its far side has it before him: x points back through the opening, the frame is
/// flush with the wall, `id` is the number of the landmark there, and nothing is known of the leaf, which
/// opens towards him.
DoorPlan FromBehind(const DoorPlan& door);

/// Every door of the plan from each side from which it can be looked at.
std::vector<DoorPlan> DoorSides(const GroundPlan& plan);

}  // namespace priamos::planner
