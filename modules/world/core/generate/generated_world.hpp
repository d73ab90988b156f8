#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/ground_plan.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::world {

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

}  // namespace priamos::world
