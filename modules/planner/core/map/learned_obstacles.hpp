#pragma once

#include <string>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"
#include "planner/core/map/obstacle_map.hpp"

namespace priamos::planner {

/// Something to be kept off, and its name for messages.
struct NamedObstacle {
  std::string name;
  Rectangle shape;
};

/// What of the learned walls and things is not on the plan, as far as it is known well enough to be planned
/// around: whose place is not known better than 15 cm says too little. What lies on something of the plan is
/// that. Of things count faces and boxes that two looks showed, that reach into the height of the base, and
/// that are not at a door, of the plan's `doors` or a learned one: no opening is closed by what may be its
/// jamb or its leaf.
std::vector<NamedObstacle> ObstaclesOf(const LearnedWalls& learned, const ObstacleMap& plan,
                                       const std::vector<DoorPlan>& doors);

}  // namespace priamos::planner
