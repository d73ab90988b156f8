#pragma once

#include <string>
#include <vector>

#include "test/bench/rivals/driver.hpp"

namespace priamos::bench {

/// All drivers of the table, the robot first. Without MRPT's navigation those of MRPT are missing.
std::vector<DriverKind> AllDrivers(const std::string& deployment);

}  // namespace priamos::bench
