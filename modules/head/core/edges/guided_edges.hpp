#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "head/core/edges/edge_refit.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// Measures edges of one image along lines on which they are expected, also those that EdgeOperator loses
/// because their pixels do not link: faint ones, and those of a blurred image. It works on the image reduced
/// by as much as its blur allows.
class GuidedEdges {
 public:
  /// Sets the image to measure (CV_8UC1), the noise of its pixels [grey values], and its blur beyond that of
  /// the pixels [px].
  GuidedEdges(const cv::Mat& image, double noise_sigma, double blur_px);

  /// Appends to `out` the edge that runs within 1.5 pixels of the reduced image beside the line from `from`
  /// to `to` [px], if there is one, of the side that is bright where it is found. It may end earlier than the
  /// line, or run on.
  bool Measure(const Eigen::Vector2d& from, const Eigen::Vector2d& to, EdgeImage& out);

 private:
  cv::Mat reduced_;
  double factor_ = 1;  ///< pixels of the image per pixel of the reduced one
  EdgeRefiner refiner_;
  EdgeImage found_;
};

}  // namespace priamos::head
