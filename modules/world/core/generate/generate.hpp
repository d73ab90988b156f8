#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "world/core/generate/generated_world.hpp"

namespace priamos::world {

/// What can be generated: "floor" a corridor with a junction and a door at its end, "corridor" a long one to
/// be driven along, "room" two rooms and a door, "storey" a corridor with rooms on both sides that are open
/// to it.
const std::vector<std::string>& GeneratedKinds();

/// A world of that kind. Doors are 80 to 100 cm wide (the one to pass at least 88), corridors 1.6 to 3 m wide
/// and 20 to 80 m long. Between the start and the task 1.25 m are free of everything that stands still;
/// beside it stand cartons, cupboards, tables, posts of 2 to 15 cm, and up to two people walk. The same seed
/// gives the same world. Throws std::invalid_argument for an unknown kind.
GeneratedWorld Generate(const std::string& kind, std::uint64_t seed);

}  // namespace priamos::world
