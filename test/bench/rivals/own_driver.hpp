#pragma once

#include <memory>
#include <string>

#include "test/bench/rivals/driver.hpp"

namespace priamos::bench {

/// The robot's process as it is shipped in `deployment`, on a bus of its own, with a start pose known to 2 cm
/// and 0.5 degrees. It is sent the path once, and nothing else: no plan, no fix; where it `replans` a further
/// path whenever mission `goto` would send one.
std::unique_ptr<Driver> OwnDriver(const Order& order, const std::string& deployment, bool replans);

}  // namespace priamos::bench
