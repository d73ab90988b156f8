#pragma once

#include "common/learned/learned_walls.hpp"

namespace priamos {

/// Enters what a robot tells of a thing into the map: a new one, or one that is there already, by its place;
/// numbers of a head mean nothing after it began anew. `told.id` is ignored. What is told again replaces what
/// was told before, and whatever else of that place it takes in: a face its edges, a box its faces. What
/// tells less than the map has (a face of a box, or what fewer looks showed) replaces it only when that was
/// not told for ten minutes, or the parts of one thing would take turns. Of more than kMostObjects that goes
/// which was not seen for longest. One that a head
/// tells elsewhere under its number, of the same looks or more, has another place now, since the pose was
/// corrected. One of 0 looks has gone: what the map has of it goes as well. Returns whether the map is
/// another one now.
bool EnterObject(const LearnedObject& told, LearnedWalls& map);

/// Whether two things are one: the middle of either lies in the other's footprint, or the middles of their
/// fronts are nearer than 30 cm and their sides are parallel within 30 degrees; and neither lies above the
/// other.
bool AreOne(const LearnedObject& a, const LearnedObject& b);

}  // namespace priamos
