#pragma once

#include <cstdint>
#include <optional>

#include "common/ground_plan.hpp"
#include "world/core/base/contact.hpp"
#include "world/core/scene/hazards.hpp"

namespace priamos::world {

/// A place within the walls of `map`, drawn evenly from all that are free, with any heading: 15 cm off every
/// solid, and off the holes and the places of people. nullopt: none was found in 10000 draws.
std::optional<Pose2> DrawFreePlace(const GroundPlan& map, const Body& body, const std::vector<Solid>& solids,
                                   const Hazards& hazards, std::uint64_t seed);

}  // namespace priamos::world
