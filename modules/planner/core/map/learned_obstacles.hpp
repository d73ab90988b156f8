#pragma once

#include <string>
#include <vector>

#include "common/learned/learned_walls.hpp"
#include "planner/core/map/obstacle_map.hpp"

namespace priamos::planner {

/// Something to be kept off, and its name for messages.
struct NamedObstacle {
  std::string name;
  Rectangle shape;
};

/// What of the learned walls is not on the plan, as far as it is known well enough to be planned around: a
/// wall whose place is not known better than 15 cm says too little. What lies on something of the plan is
/// that.
std::vector<NamedObstacle> ObstaclesOf(const LearnedWalls& learned, const ObstacleMap& plan);

}  // namespace priamos::planner
