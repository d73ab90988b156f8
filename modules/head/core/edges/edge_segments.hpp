#pragma once

#include <opencv2/core/mat.hpp>
#include <utility>
#include <vector>

#include "head/core/edges/chain_split.hpp"
#include "head/core/edges/edge_chains.hpp"
#include "head/core/edges/edge_refit.hpp"
#include "head/core/edges/edge_segment.hpp"
#include "head/core/edges/gradient_map.hpp"
#include "head/core/edges/segment_fusion.hpp"
#include "head/core/edges/segment_map.hpp"

namespace priamos::head {

/// Weaker edges tell no more, however dark the image [grey values].
inline constexpr double kWeakestEdge = 3;

/// The edge operator: Sobel gradients, linked pixels, straight pieces, sub-pixel refit, fusion of broken
/// edges. Keeps its buffers, so one object per thread and camera size is fast.
class EdgeOperator {
 public:
  /// Settings of the operator and of its steps.
  struct Options {
    double min_contrast = 10;    ///< weakest edge of a quiet image [grey values]
    double usual_grey = 0;       ///< mean of a well exposed image; in darker ones weaker edges count, in
                                 ///< proportion, down to kWeakestEdge; 0: in none
    double noise_factor = 2.36;  ///< a pixel is linked above so many standard deviations of the gradient
    double min_length_px = 12;   ///< shortest segment
    ChainSplitter::Options split;
    EdgeRefiner::Options refit;
    bool fuse = true;  ///< join what is broken (section 4.1)
    FusionOptions fusion;
  };

  EdgeOperator() = default;
  explicit EdgeOperator(const Options& options) : options_(options) {}

  /// Extracts the edges of an image. Throws std::invalid_argument unless it is CV_8UC1, at least 32x32.
  void Extract(const cv::Mat& image, EdgeImage& out);

 private:
  Options options_;
  GradientMap gradients_;
  ChainTracer tracer_;
  ChainSplitter splitter_;
  EdgeRefiner refiner_;
  SegmentMap found_;

  EdgeChains chains_;
  std::vector<RoughLine> rough_;
  std::vector<std::pair<float, int>> order_;
};

}  // namespace priamos::head
