#pragma once

#include "common/learned/learned_walls.hpp"

namespace priamos {

/// The walls without those that are edges or corners of longer ones. A sonar hears an edge from all sides, on
/// an arc; a piece of the arc that is short, or driven past in a bend, is taken for a wall that stands askew
/// where another one ends (Leonard and Durrant-Whyte 1992 on what arcs tell). Left out is what is shorter
/// than 2.2 m, is turned by 12 degrees and more against a longer wall, its perpendicular included, and lies
/// within half a metre of the end of it or crosses it. A true short wall that stands askew there is lost with
/// them.
LearnedWalls WithoutEdges(const LearnedWalls& walls);

}  // namespace priamos
