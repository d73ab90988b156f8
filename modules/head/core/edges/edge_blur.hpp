#pragma once

#include <opencv2/core/mat.hpp>

#include "head/core/edges/edge_profile.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// Measures how wide the edges of one image are. A Gaussian edge of variance v, seen through a kernel of
/// variance k, has a third derivative of -1 / (v + k) times the first (local scale; Elder and Zucker 1998).
class EdgeBlurMeter {
 public:
  /// Sets the image to measure (CV_8UC1), which is referred to until the next call.
  void SetImage(const cv::Mat& image) { profile_.SetImage(image); }

  /// Standard deviation of the blur across `segment` [px], that of the pixels left out; 0 for a needle-sharp
  /// edge, infinity where nothing of the contrast is there or the blur cannot be measured.
  double Blur(const EdgeSegment& segment) const;

 private:
  EdgeProfile profile_;
};

}  // namespace priamos::head
