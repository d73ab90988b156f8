#pragma once

#include <opencv2/core/mat.hpp>

#include "head/core/chain_split.hpp"
#include "head/core/edge_kernels.hpp"

namespace priamos::head {

/// A line as `across = offset + slope * (along - origin)`; `along` counts rows if it is steep, else columns.
struct AxisLine {
  bool steep = true;
  int sign = 1;  ///< of the contrast in the direction of growing `across`
  double origin = 0, offset = 0, slope = 0;

  double Across(double along) const { return offset + slope * (along - origin); }
  /// Length along the line per unit of `along`.
  double Stretch() const { return std::sqrt(1 + slope * slope); }
};

/// Derivatives of the grey values across a line, summed over a few rows, signed so that strength and
/// sharpness are positive where the line lies on an edge of its contrast.
struct EdgeSums {
  int rows = 0;
  double along = 0;     ///< mean row
  double strength = 0;  ///< first derivative
  /// Second derivative and minus third, for each KernelWidth: their quotient is how far beside the line the
  /// edge lies.
  double imbalance[2] = {0, 0}, sharpness[2] = {0, 0};
  double low = 0, high = 0;  ///< grey values on the sides of small and large `across`

  double shift(KernelWidth width) const { return imbalance[int(width)] / sharpness[int(width)]; }
  EdgeSums& operator+=(const EdgeSums& other);
};

/// Measures a raw image across lines.
class EdgeProfile {
 public:
  /// Refers to `image` (CV_8UC1) until the next call.
  void SetImage(const cv::Mat& image);

  /// Rows (or columns) first, first + step, ... up to `last`; those too near the border are left out.
  EdgeSums Sum(const AxisLine& line, int first, int last, int step = 1) const;
  /// Number of rows (or columns) of the image.
  int Extent(const AxisLine& line) const { return line.steep ? image_.rows : image_.cols; }

 private:
  cv::Mat image_, transposed_;
};

}  // namespace priamos::head
