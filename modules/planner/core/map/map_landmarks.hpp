#pragma once

#include <optional>

#include "common/ground_plan.hpp"
#include "planner/core/map/landmark.hpp"

namespace priamos::planner {

/// The landmark of the map with this number, door from either side or cupboard; nullopt if there is none.
std::optional<Landmark> MakeLandmark(const GroundPlan& plan, int id);

}  // namespace priamos::planner
