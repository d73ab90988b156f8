#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "common/random.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::test {

/// A straight edge as it truly is [px].
struct TrueLine {
  Eigen::Vector2d begin, end;
};

/// A picture with known edges.
struct LineScene {
  cv::Mat image;  ///< CV_8UC1
  std::vector<TrueLine> lines;
};

/// Rectangles of random size and angle, 12 in 768 x 576 pixels, brighter or darker than the ground by
/// `contrast`; every pixel is the exact mean over its area, then blurred like a lens and noised like a
/// sensor.
LineScene RandomRectangles(double contrast, double noise, double blur_px, Rng& rng);

/// How well segments match true lines.
struct LineScore {
  std::vector<double> end_errors_px;  ///< distance of segment ends from their true line
  double mean_error_px = 0;
  double coverage = 0;  ///< share of the true length that is covered
  double broken = 0;    ///< share of lines in more than one piece
  double pieces = 0;    ///< per line found
  int n_false = 0;      ///< segments of no line
  double wrong_unions =
      0;            ///< share of segments that run on where their line has ended, onto another or none
  double nees = 0;  ///< mean squared error across the line, in units of sigma_normal_px
};

/// Adds up over scenes.
class LineScorer {
 public:
  void Add(const std::vector<TrueLine>& lines, const std::vector<head::EdgeSegment>& segments);
  LineScore Score() const;

 private:
  std::vector<double> errors_;
  double covered_ = 0, length_ = 0, nees_ = 0;
  int n_lines_ = 0, n_found_ = 0, n_broken_ = 0, n_pieces_ = 0, n_false_ = 0, n_overlong_ = 0,
      n_segments_ = 0;
};

}  // namespace priamos::test
