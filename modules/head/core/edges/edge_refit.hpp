#pragma once

#include <opencv2/core/mat.hpp>

#include "head/core/edges/edge_blocks.hpp"
#include "head/core/edges/edge_fit.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// Brings rough lines to sub-pixel accuracy on the raw image, and finds where they end.
///
/// Along every row that a steep line crosses (every column for a flat one) the grey values are weighted with
/// derivatives of a Gaussian centred on the line. The edge is where the second derivative vanishes; summed
/// over rows this is linear in the grey values, so noise averages out with the length, without the bias of
/// peaks taken pixel by pixel. Two widths are measured: the wide one is less noisy, the narrow one less
/// disturbed by neighbouring edges; where they contradict each other the narrow one is believed.
class EdgeRefiner {
 public:
  /// Which edges are kept, and how exact the best are taken to be.
  struct Options {
    double min_length_px = 12;
    double min_contrast = 4;      ///< grey values; noise may demand more
    double min_significance = 6;  ///< mean contrast over its standard deviation
    double max_spread_px = 2.8;   ///< blur of kernel and edge together; softer ones are shadows
    double floor_px = 0.005;      ///< systematic part of sigma_normal_px: sampling, shading
  };

  /// Sets the image to measure (CV_8UC1), which is referred to until the next call, and its noise [grey
  /// values].
  void SetImage(const cv::Mat& image, double noise_sigma);

  /// Appends to `out` the segment near `rough` and its points; false if there is none.
  bool Refine(const RoughLine& rough, const Options& options, EdgeImage& out);

 private:
  bool IsClear(const AxisLine& line, const Options& options) const;
  bool Choose(EdgeOffset& fit);
  void Append(const AxisLine& line, const EdgeOffset& fit, const Options& options, EdgeImage& out) const;
  void AppendPoints(const AxisLine& measured, const EdgeOffset& fit, const Options& options,
                    EdgeImage& out) const;

  EdgeBlocks blocks_;
  EdgeFitter fitter_;
  double noise_sigma_ = 0;
};

}  // namespace priamos::head
