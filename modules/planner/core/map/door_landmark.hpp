#pragma once

#include "common/ground_plan.hpp"
#include "planner/core/map/landmark.hpp"

namespace priamos::planner {

/// The skeleton of a door for a viewer who approaches it: per side the outer arris of the frame, the front
/// arris of the jamb and the arris of the leaf's stop in the depth of the wall, and the same three above.
/// Edges of the far side are left out: the leaf hides or moves them. Where the map has the leaf's angle its
/// edges follow as a movable part, as far as they are seen past the frame; of a closed leaf nothing is.
Landmark MakeDoorLandmark(const DoorPlan& door);

}  // namespace priamos::planner
