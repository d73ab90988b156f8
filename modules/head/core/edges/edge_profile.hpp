#pragma once

#include <Eigen/Core>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "head/core/edges/chain_split.hpp"
#include "head/core/edges/edge_kernels.hpp"

namespace priamos::head {

/// A line as `across = offset + slope * (along - origin)`; `along` counts rows if it is steep, else columns.
struct AxisLine {
  bool steep = true;
  int sign = 1;  ///< sign of the contrast in the direction of growing `across`
  double origin = 0, offset = 0, slope = 0;
  const EdgeKernelSet *wide = nullptr, *narrow = nullptr;  ///< kernels for this slope

  void ChooseKernels() {
    wide = &KernelsFor(KernelWidth::kWide, std::abs(slope));
    narrow = &KernelsFor(KernelWidth::kNarrow, std::abs(slope));
  }
  const EdgeKernelSet& kernels(KernelWidth width) const {
    return width == KernelWidth::kWide ? *wide : *narrow;
  }
  double Across(double along) const { return offset + slope * (along - origin); }
  /// The point at (`along`, `at`) in image coordinates [px].
  Eigen::Vector2d Point(double along, double at) const {
    return steep ? Eigen::Vector2d(at, along) : Eigen::Vector2d(along, at);
  }
  /// Length along the line per unit of `along`.
  double Stretch() const { return std::sqrt(1 + slope * slope); }
};

/// Derivatives of the grey values across a line, summed over a few rows, signed so that strength and
/// sharpness are positive where the line lies on an edge of its contrast.
struct EdgeSums {
  float along = 0;     ///< mean row
  float rows = 0;      ///< number of rows
  float strength = 0;  ///< first derivative
  float inverse = 0;   ///< 1 / strength, 0 where there is none
  /// Second derivative, and minus the third, for each KernelWidth: their quotient is the distance of the edge
  /// from the line.
  float imbalance[2] = {0, 0}, sharpness[2] = {0, 0};
  float low = 0, high = 0;  ///< grey values on the sides of small and large `across`

  /// Adds all but `along` and `inverse`.
  void Add(const EdgeSums& other) {
    rows += other.rows;
    strength += other.strength;
    low += other.low;
    high += other.high;
    for (int i = 0; i < 2; ++i) {
      imbalance[i] += other.imbalance[i];
      sharpness[i] += other.sharpness[i];
    }
  }
};

/// Measures a raw image across lines.
class EdgeProfile {
 public:
  /// Sets the image to measure (CV_8UC1), which is referred to until the next call.
  void SetImage(const cv::Mat& image);

  /// The sums over rows (or columns) from `first` to `last`; those too near the border are left out.
  EdgeSums Sum(const AxisLine& line, int first, int last) const;
  /// Number of rows (or columns) of the image.
  int Extent(const AxisLine& line) const { return line.steep ? image_.rows : image_.cols; }

 private:
  cv::Mat image_, transposed_;
};

}  // namespace priamos::head
