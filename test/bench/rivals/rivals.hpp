#pragma once

#include <string>
#include <vector>

#include "test/bench/rivals/driver.hpp"

namespace priamos::bench {

/// All drivers of the table: the robot, the robot with a planner that plans anew as mission `goto` does, then
/// those of the file `tuning`. Without MRPT's navigation its rows are missing. Throws ConfigError.
std::vector<DriverKind> AllDrivers(const std::string& deployment, const std::string& tuning);

}  // namespace priamos::bench
