#pragma once

#include <string>

#include "common/config.hpp"

namespace priamos::cli {

/// The folder of logs of the `up` that a verb means: `log_root` if one runs from there, else the folder of
/// the one that is heard on the buses of `robot` by the interface `network`, if it is on this computer; else
/// `log_root`. Listens for half a second when none runs from there.
std::string LogRootInUse(const std::string& log_root, const std::string& robot, const std::string& network);

/// The configuration of the planner that orders go to: of the deployment `named`; when none is named, of the
/// one that is up from the folder of logs `log_root`, with the map of the scenario that it is in; of sim when
/// nothing is up. Throws ConfigError when it is not found.
ConfigSource PlannerInUse(const std::string& named, const std::string& log_root);

}  // namespace priamos::cli
