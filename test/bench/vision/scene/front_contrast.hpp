#pragma once

#include "test/bench/vision/scene/scene_looks.hpp"

namespace priamos::bench {

/// Of the upper half of a front's left and right edge and of its upper edge, that part which has contrast:
/// the smaller share of both pictures.
struct FrontContrast {
  double left = 0, right = 0, top = 0;

  /// Whether all three can be told from what is beside them, at least half of each.
  bool IsSeen() const { return left > 0.5 && right > 0.5 && top > 0.5; }
};

/// Where the front's edges really are, whatever any operator made of it.
FrontContrast ContrastOf(const TrueFront& front, const SceneLook& look);

}  // namespace priamos::bench
