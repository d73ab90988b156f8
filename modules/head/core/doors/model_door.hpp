#pragma once

#include <optional>

#include "common/ground_plan.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// The door that a landmark model shows, in its landmark frame: opening, front and stop from its uprights,
/// rebate and leaf as doors usually have them (DoorPlan's defaults). nullopt if the model is no door's: a
/// door has jambs, two uprights one behind the other on either side, and a frame around them.
std::optional<DoorPlan> DoorOf(const LandmarkModel& model);

}  // namespace priamos::head
