#include <array>

#include "head/core/calibration/discs/disc_fit.hpp"
#include "head/core/calibration/discs/disc_window.hpp"

namespace priamos::head {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kRingWidth_px = 2.0;  // of the ring that gives the background

/// The value below which `share` of the histogram lies, and -1 if the histogram is empty. Interpolated
/// within the grey level, as if each level were spread over one.
double Quantile(const std::array<int, 256>& histogram, double share) {
  double total = 0;
  for (const int n : histogram) total += n;
  if (total == 0) return -1;
  double below = 0;
  for (int level = 0; level < 256; ++level) {
    if (below + histogram[level] >= share * total && histogram[level] > 0) {
      return level - 0.5 + (share * total - below) / histogram[level];
    }
    below += histogram[level];
  }
  return 255;
}

/// Medians of the ring around the disc and of its inner part.
bool MeasureLevels(const GreyImage& image, const Ellipse& guess, std::span<const Ellipse> others,
                   DetectedDisc& disc) {
  const Ellipse inner_rim = Grown(guess, kRimReach_px),
                outer_rim = Grown(guess, kRimReach_px + kRingWidth_px);
  const std::optional<Box> box = BoundingBox(image, outer_rim);
  if (!box) return false;
  const double inner = inner_rim.shape_px2.determinant() / outer_rim.shape_px2.determinant();
  const double core = 0.36 * guess.shape_px2.determinant() / outer_rim.shape_px2.determinant();
  const double inner_q2 = std::sqrt(inner), core_q2 = std::sqrt(core);
  std::array<int, 256> ring{}, plateau{};
  ForEachPixel(image, *box, outer_rim, others, [&](double, double, double q2, std::uint8_t grey) {
    if (q2 > inner_q2) ++ring[grey];
    if (q2 < core_q2) ++plateau[grey];
  });
  const double top = Quantile(plateau, 0.5);
  disc.background = Quantile(ring, 0.5);
  disc.amplitude = top - disc.background;
  return top >= 0 && disc.background >= 0 && disc.amplitude > 1;
}

/// The ellipse with the moments of what stands out of the background within the window.
std::optional<Ellipse> MomentsWithin(const GreyImage& image, const Ellipse& window,
                                     std::span<const Ellipse> others, const DetectedDisc& levels) {
  const std::optional<Box> box = BoundingBox(image, window);
  if (!box) return std::nullopt;
  double sum = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  ForEachPixel(image, *box, window, others, [&](double dx, double dy, double, std::uint8_t grey) {
    const double weight = grey - levels.background;
    sum += weight;
    x += weight * dx;
    y += weight * dy;
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
  });
  if (sum < levels.amplitude) return std::nullopt;
  const Vector2d mean(x / sum, y / sum);
  Matrix2d covariance;
  covariance << xx / sum, xy / sum, xy / sum, yy / sum;
  covariance -= mean * mean.transpose();
  // A uniform ellipse has covariance shape/4; the pixels' extent is taken off, the unknown blur is not.
  const Ellipse found{window.centre_px + mean, 4 * (covariance - kPixelVariance * Matrix2d::Identity())};
  const bool positive = found.shape_px2(0, 0) > 0.5 && found.shape_px2.determinant() > 0.25;
  return positive ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<DetectedDisc> MeasureMoments(const GreyImage& image, const Ellipse& guess,
                                           std::span<const Ellipse> others) {
  DetectedDisc disc;
  if (!MeasureLevels(image, guess, others, disc)) return std::nullopt;
  disc.ellipse = guess;
  // The second pass has the window in the right place and of the right shape.
  for (int pass = 0; pass < 2; ++pass) {
    const std::optional<Ellipse> next = MomentsWithin(image, Grown(disc.ellipse, kRimReach_px), others, disc);
    if (!next) return std::nullopt;
    disc.ellipse = *next;
  }
  disc.blur_sigma_px = 0.7;
  return disc;
}

}  // namespace priamos::head
