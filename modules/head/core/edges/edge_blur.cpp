#include "head/core/edges/edge_blur.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos::head {
namespace {

constexpr int kRows = 64;               ///< rows summed at a time: the sums of more could overflow
constexpr double kPixel_px2 = 1 / 12.;  ///< variance of a pixel's box

/// The line of `segment`; from `first` to `last` in rows or columns.
AxisLine LineOf(const EdgeSegment& segment, int& first, int& last) {
  const Eigen::Vector2d delta = segment.end - segment.begin, middle = (segment.begin + segment.end) / 2;
  AxisLine line;
  line.steep = std::abs(delta.y()) >= std::abs(delta.x());
  const int along = line.steep ? 1 : 0, across = 1 - along;
  line.sign = (line.steep ? delta.y() < 0 : delta.x() > 0) ? 1 : -1;  // bright on the right hand
  line.origin = middle[along];
  line.offset = middle[across];
  line.slope = delta[along] == 0 ? 0 : delta[across] / delta[along];
  const auto [low, high] = std::minmax(segment.begin[along], segment.end[along]);
  first = static_cast<int>(std::ceil(low));
  last = static_cast<int>(std::floor(high));
  line.ChooseKernels();
  return line;
}

}  // namespace

double EdgeBlurMeter::Blur(const EdgeSegment& segment) const {
  int first = 0, last = 0;
  const AxisLine line = LineOf(segment, first, last);
  EdgeSums total;
  for (int t = first; t <= last; t += kRows) total.Add(profile_.Sum(line, t, std::min(t + kRows - 1, last)));
  const double strength = total.strength, sharpness = total.sharpness[int(KernelWidth::kWide)];
  if (total.rows <= 0 || strength <= 0 || sharpness <= 0) return std::numeric_limits<double>::infinity();
  const double in_row = strength / sharpness - line.wide->sigma_px * line.wide->sigma_px - kPixel_px2;
  return std::sqrt(std::max(0.0, in_row / (line.Stretch() * line.Stretch()) - kPixel_px2));
}

}  // namespace priamos::head
