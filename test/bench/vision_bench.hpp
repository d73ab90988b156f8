#pragma once

#include <string>
#include <vector>

#include "test/bench/figures.hpp"

namespace priamos::bench {

/// What a run of the bench is asked to do.
struct VisionOptions {
  bool quick = false;               ///< a tenth of the samples
  std::vector<std::string> photos;  ///< for times; scaled to 768 x 576
};

/// Time, accuracy and completeness of the edge operator, beside OpenCV's LSD and EdgeDrawing.
void BenchEdges(const VisionOptions& options, Figures& figures);

/// Wrong matches of edges with three cameras against two.
void BenchStereo(const VisionOptions& options, Figures& figures);

}  // namespace priamos::bench
