#pragma once

#include <nlohmann/json.hpp>

#include "common/ground_plan.hpp"

namespace priamos::console {

/// A ground plan as the page draws it: {"walls": [[[x, y], ...4]], "doors": [{"id", "name", "x_m", "y_m",
/// "yaw_rad", "width_m", "depth_m"}], "cupboards": [{"id", "name", "corners"}]}, map frame [m, rad]. depth_m:
/// thickness of the door's wall.
nlohmann::ordered_json ToJson(const GroundPlan& plan);

}  // namespace priamos::console
