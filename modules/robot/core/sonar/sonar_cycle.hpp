#pragma once

#include <array>

#include "common/sonar_ring.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// One cycle of the ring.
struct SonarCycle {
  Time time{};
  /// First echo of each sensor; anything outside 0..kSonarMax_m is no echo.
  std::array<double, kSonars> range_m{};
};

}  // namespace priamos::robot
