#pragma once

namespace priamos {

/// How far a line of a path may be left to either side, around obstacles that the plan does not know [m].
struct Leeway {
  double left_m = 0, right_m = 0;

  /// Whether the line may be left at all: one that may not is planned to the centimetre.
  bool any() const { return left_m > 0 || right_m > 0; }
};

}  // namespace priamos
