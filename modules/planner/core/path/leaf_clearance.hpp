#pragma once

#include <string>

#include "common/ground_plan.hpp"

namespace priamos::planner {

/// Width [m] that a leaf hinged on `hinge` ("left" or "right") and open by `open_rad` leaves free for a base
/// that drives straight through the opening: from the leaf to the other jamb, 0 if the leaf reaches it.
double FreeWidth(const DoorPlan& door, const std::string& hinge, double open_rad);

}  // namespace priamos::planner
