#pragma once

#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {

/// Fixes at a door of the map when one camera sees in another light than the other.
void BenchDoorLight(const VisionOptions& options, Figures& figures);

}  // namespace priamos::bench
