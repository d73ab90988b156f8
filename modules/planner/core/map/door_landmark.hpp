#pragma once

#include "common/ground_plan.hpp"
#include "planner/core/map/landmark.hpp"

namespace priamos::planner {

/// The skeleton of a door for a viewer who approaches it: per side the outer arris of the frame, the front
/// arris of the jamb and the arris of the leaf's stop in the depth of the wall, and the same three above.
/// Edges of the far side are left out: the leaf hides or moves them. Where the map has the leaf's angle its
/// edges follow as a movable part, as far as they are seen past the frame; of a closed leaf nothing is.
Landmark MakeDoorLandmark(const DoorPlan& door);

/// The skeleton of the same door, as drawn for its approach side, for a viewer who comes from behind: per
/// side the edge of its frame, the arris of the stop and the far one of the jamb, and the same three above.
/// The arris of the rebate is left out: it lies too near to the stop's. The landmark is that of
/// FromBehind(door): x points back through the opening. An open leaf hides the first edge of its own side.
/// `door.behind_id` is its number.
Landmark MakeDoorLandmarkFromBehind(const DoorPlan& door);

}  // namespace priamos::planner
