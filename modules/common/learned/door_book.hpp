#pragma once

#include <optional>

#include "common/learned/learned_walls.hpp"

namespace priamos {

/// Enters what a robot tells of a door into the map: a new one, or one that is there already, by its place;
/// numbers of a head mean nothing after it began anew. `told.id` is ignored. What is told again replaces what
/// was told before, the time of a change of state is kept. Returns whether the map is another one now.
bool EnterDoor(const LearnedDoor& told, LearnedWalls& map);

/// Doors of the map that were seen since then, as words: `3 doors on the way: 1 closed, 1 open, 1 ajar`;
/// empty: none was.
std::string DoorsSeenSince(const LearnedWalls& map, double since_s);

}  // namespace priamos
