#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world/core/generate/sketch.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

/// What can be generated: "floor" a corridor with a junction and a door at its end, "corridor" a long one to
/// be driven along, "room" two rooms and a door, "storey" a corridor with rooms on both sides that are open
/// to it.
const std::vector<std::string>& GeneratedKinds();

/// A world made up from a seed.
struct GeneratedWorld {
  GroundPlan truth;              ///< as it is
  GroundPlan surveyed;           ///< as the planner's map has it
  WorldPlan world;               ///< all else that stands there; `map` is left empty
  int door_id = 1;               ///< the door to pass
  std::vector<Pose2> waypoints;  ///< places to drive to, none when the door is the task
  std::optional<Pose2>
      corridor_end;          ///< where a base comes to rest that follows the corridor; none in a room
  std::vector<Pose2> round;  ///< through that door to a place behind it, and back; none without one
};

/// A world of that kind. Doors are 80 to 100 cm wide (the one to pass at least 88), corridors 1.6 to 3 m wide
/// and 20 to 80 m long. Between the start and the task 1.25 m are free of everything that stands still;
/// beside it stand cartons, cupboards, tables, posts of 2 to 15 cm, and up to two people walk. The same seed
/// gives the same world. Throws std::invalid_argument for an unknown kind.
GeneratedWorld Generate(const std::string& kind, std::uint64_t seed);

}  // namespace priamos::world
