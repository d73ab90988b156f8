#pragma once

#include "common/ground_plan.hpp"
#include "planner/core/map/landmark.hpp"

namespace priamos::planner {

/// The skeleton of a cupboard: its box, and on its front the gaps between the doors and the plinth. Both
/// sides of a gap are edges; the head leaves out pairs that it cannot resolve from where it stands.
/// Origin: middle of the front on the floor; x points into the cupboard, as it points through a door.
Landmark MakeCupboardLandmark(const CupboardPlan& cupboard);

}  // namespace priamos::planner
