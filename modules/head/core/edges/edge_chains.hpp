#pragma once

#include <cstdint>
#include <vector>

#include "head/core/edges/gradient_map.hpp"

namespace priamos::head {

/// One pixel of an edge chain.
struct ChainPixel {
  std::int16_t x, y;
};

/// Chains of edge pixels, one after the other in one vector.
struct EdgeChains {
  std::vector<ChainPixel> pixels;
  std::vector<int> begins;  ///< first pixel of each chain, and the end of the last one

  int size() const { return begins.empty() ? 0 : static_cast<int>(begins.size()) - 1; }
};

/// Links pixels of strong gradient: from every local maximum on a coarse grid it walks along the edge, both
/// directions, always to the strongest of the three pixels ahead (as in edge drawing; Topal and Akinlar
/// 2012). The walk keeps the bright side on the same hand, so a chain never changes its contrast sign.
class ChainTracer {
 public:
  /// Which pixels are linked; magnitudes are Sobel sums of 8-bit grey values.
  struct Options {
    double link_threshold = 12;  ///< magnitude to go on [Sobel sum]
    double seed_threshold = 24;  ///< magnitude to begin
    int min_pixels = 10;         ///< shorter chains are dropped
  };
  void Trace(const GradientMap& gradients, const Options& options, EdgeChains& chains);

 private:
  void CloseBorder(int height);
  void SeedRow(const GradientMap& gradients, const Options& options, int y, EdgeChains& chains);
  void SeedColumns(const GradientMap& gradients, const Options& options, EdgeChains& chains);
  void TraceFrom(const GradientMap& gradients, const Options& options, int x, int y, EdgeChains& chains);
  struct Heading;
  bool Step(const GradientMap& gradients, int threshold, const Heading& heading, int& at, ChainPixel& pixel);
  ChainPixel* Follow(const GradientMap& gradients, int threshold, ChainPixel seed, int hand, ChainPixel* out);

  int stride_ = 0;
  std::vector<std::uint8_t> visited_;
  std::vector<unsigned short> columns_;  ///< magnitudes of every kGrid-th column
  std::vector<ChainPixel> walk_;
};

}  // namespace priamos::head
