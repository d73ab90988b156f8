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
    const double least_m = std::min(left_m, right_m);
    return least_m > 0 && least_m < kLittle_m;
  }
  /// Whether it leads through the middle of a narrow passage: the base keeps to the middle between what it
  /// hears, and single echoes, which are broad, do not close it.
  bool narrow() const {
    return std::min(left_m, right_m) > kLittle_m && std::max(left_m, right_m) < kMostNarrow_m;
  }

 private:
  static constexpr double kLittle_m = 0.15, kMostNarrow_m = 0.25;
};

/// That of a line through the middle of a narrow passage.
inline constexpr Leeway kNarrowLine{0.2, 0.2};

}  // namespace priamos
