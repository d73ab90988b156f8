#pragma once

#include <vector>

#include "world/core/scene/device_faults.hpp"
#include "world/core/scene/holes.hpp"
#include "world/core/scene/leaf_swing.hpp"
#include "world/core/scene/person_plan.hpp"

namespace priamos::world {

/// What a world has beyond solids that stand still and a robot that is sound, as drawn for this run.
struct Hazards {
  std::vector<PersonPlan> people;
  std::vector<MovedLeaf> leaves;
  std::vector<HolePlan> holes;
  FaultsPlan faults;
  MastPlan mast;
};

}  // namespace priamos::world
