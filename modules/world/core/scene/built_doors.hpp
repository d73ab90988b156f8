#pragma once

#include <cstdint>
#include <vector>

#include "common/ground_plan.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// The door with the differences that the world names.
DoorPlan AsBuilt(DoorPlan door, const DoorWork& work);

/// The doors of the map as they were built, in its order: with the errors of the world's survey and what the
/// world says of each door.
std::vector<DoorPlan> BuiltDoors(const GroundPlan& map, const WorldPlan& plan, std::uint64_t seed);

}  // namespace priamos::world
