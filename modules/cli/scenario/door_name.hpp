#pragma once

#include <string>

#include "common/ground_plan.hpp"

namespace priamos::cli {

/// The id of the door that a person calls `name`: its name in the map, or its number, which need not be in
/// this map. Throws ConfigError that names the nearest ones; `map` names where the plan is from.
int DoorNamed(const GroundPlan& plan, const std::string& name, const std::string& map);

/// The same in the map that the planner of the deployment in `folder` has.
int DoorOfDeployment(const std::string& folder, const std::string& name);

}  // namespace priamos::cli
