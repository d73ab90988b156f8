#pragma once

#include <string>
#include <vector>

#include "cli/supervise/deployment.hpp"

namespace priamos::cli {

/// A scenario in whose world a simulated robot can be.
struct OfferedScenario {
  std::string name, title;
};

/// Those that the deployment in `folder` names. Throws ConfigError for one that is not there or cannot be
/// read, for more than simulation_t holds, or names that are longer.
std::vector<OfferedScenario> OfferedScenarios(const Deployment& deployment, const std::string& folder);

/// `deployment` in the world of one of its scenarios: what that sets of a process holds instead, and planner
/// and station have its map, unless it is in the deployment's own world. Throws ConfigError; an unknown name
/// is answered with the known ones.
Deployment InScenario(Deployment deployment, const std::string& folder, const std::string& name);

}  // namespace priamos::cli
