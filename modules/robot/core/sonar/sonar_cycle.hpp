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

/// False for NaN and for the "none" of -1.
inline bool IsEcho(double range_m) {
  return range_m >= 0 && range_m <= kSonarMax_m;
}

}  // namespace priamos::robot
