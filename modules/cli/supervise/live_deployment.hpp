#pragma once

#include <string>

#include "common/config.hpp"

namespace priamos::cli {

/// The configuration of the planner that orders go to: of the deployment `named`; when none is named, of the
/// one that is up from the folder of logs `log_root`, with the map of the scenario that it is in; of sim when
/// nothing is up. Throws ConfigError when it is not found.
ConfigSource PlannerInUse(const std::string& named, const std::string& log_root);

}  // namespace priamos::cli
