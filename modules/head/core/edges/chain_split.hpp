#pragma once

#include <vector>

#include "head/core/edges/edge_chains.hpp"

namespace priamos::head {

/// A straight piece of a chain, to pixel accuracy, in the direction of the chain.
struct RoughLine {
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;  ///< ends, on the fitted line [px]
};

/// Cuts chains into straight pieces: a line grows pixel by pixel while the pixels stay near its least squares
/// fit, and ends when several in a row have left it.
class ChainSplitter {
 public:
  /// Limits at which a straight piece begins and ends.
  struct Options {
    int min_pixels = 10;           ///< a line begins with so many pixels and is never shorter
    double begin_rms_px = 0.5;     ///< largest RMS distance of these pixels from their line
    double max_distance_px = 1.5;  ///< a pixel farther away has left the line
    int max_strays = 4;            ///< so many such pixels in a row end the line
  };
  void Split(const GradientMap& gradients, const EdgeChains& chains, const Options& options,
             std::vector<RoughLine>& lines) const;
};

}  // namespace priamos::head
