#pragma once

#include "common/ground_plan.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// Throws ConfigError, `file:line:key: expected ..., got ...`, where a world contradicts its map or itself:
/// what hangs on a wall that is not there or not so long, a door that the map does not have, and whatever is
/// said twice.
void CheckAgainstMap(const WorldPlan& plan, const GroundPlan& map);

}  // namespace priamos::world
