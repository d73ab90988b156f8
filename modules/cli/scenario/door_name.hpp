#pragma once

#include <string>

#include "common/config.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// The id of the door that a person calls `name`: its name in the map, or its number, which need not be in
/// this map. Throws ConfigError that names the nearest ones; `map` names where the plan is from.
int DoorNamed(const GroundPlan& plan, const std::string& name, const std::string& map);

/// The same in the map of the planner that has the configuration `planner`.
int DoorOfPlanner(const ConfigSource& planner, const std::string& name);

}  // namespace priamos::cli
