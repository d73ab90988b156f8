#pragma once

#include <cstdint>

#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// The world as it is on the day of this seed: without the people and faults that chance leaves out, with a
/// sensor drawn for a fault of any, and with what is strewn on the floor as boxes. What is strewn keeps out
/// of the free lanes, 10 cm off other boxes, and leaves people the places where they stand. A thing that
/// finds no place is left out.
WorldPlan OfTheDay(WorldPlan plan, std::uint64_t seed);

}  // namespace priamos::world
