#pragma once

#include <cstdint>

#include "world/core/generate/generated_world.hpp"

namespace priamos::world {

/// A storey to be explored: a corridor of 14 to 34 m, 1.8 to 2.6 m wide, with rooms on both sides, 4 to 7 m
/// wide and 3.5 to 6 m deep, most of them open to it by 1.2 to 1.7 m, some behind a closed door; a closed
/// door at the end of the corridor; cupboards in the rooms. 130 to 480 m2.
GeneratedWorld GenerateStorey(std::uint64_t seed);

}  // namespace priamos::world
