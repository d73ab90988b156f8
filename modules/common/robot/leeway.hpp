#pragma once

#include <algorithm>

namespace priamos {

/// How far a line of a path may be left to either side, around obstacles that the plan does not know [m].
struct Leeway {
  double left_m = 0, right_m = 0;

  /// Whether the line may be left at all: one that may not is planned to the centimetre.
  bool any() const { return left_m > 0 || right_m > 0; }
  /// Whether it may be left by a little to either side: things are near, and nobody planned to the
  /// centimetre.
  bool little() const {
    constexpr double kLittle_m = 0.15;
    const double least_m = std::min(left_m, right_m);
    return least_m > 0 && least_m < kLittle_m;
  }
};

}  // namespace priamos
