#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/ground_plan.hpp"
#include "world/core/scene/solid.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// All solids of a world: walls (cut where doors are) with skirting, frames, leaves and thresholds, posters
/// and boxes, those with a spread drawn from the seed. Names are unique. Throws ConfigError with a sentence
/// when the world names a wall or door that the map does not have, or a door stands in no wall.
std::vector<Solid> BuildSolids(const GroundPlan& map, const WorldPlan& plan, std::uint64_t seed);

/// Frame, leaf and threshold of one door, from its landmark frame. Names begin with the door's name.
std::vector<Solid> DoorSolids(const DoorPlan& built, const DoorWork& work, double open_deg);

/// Name of the solid that is a door's leaf.
std::string LeafName(const DoorPlan& door);

}  // namespace priamos::world
