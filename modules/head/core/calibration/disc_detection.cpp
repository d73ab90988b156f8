#include "head/core/calibration/disc_detection.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "head/core/calibration/bright_regions.hpp"

namespace priamos::head {

namespace {

constexpr double kUsualNoise = 4;  // grey levels of camera noise that are no misfit

bool Plausible(const BrightRegion& r, const DiscDetectorOptions& options) {
  const int small = std::min(r.width(), r.height()), large = std::max(r.width(), r.height());
  if (small < 2 * options.min_radius_px - 2 || large > 2 * options.max_radius_px + 4) return false;
  if (small < options.min_axis_ratio * large - 3) return false;
  // Every second row was counted: half the box would be full.
  const double filled = 2.0 * r.pixels / (r.width() * r.height());
  return filled > 0.3;
}

Ellipse FirstGuess(const BrightRegion& r) {
  Ellipse guess;
  guess.centre_px = {(r.u_min + r.u_max) / 2.0, (r.v_min + r.v_max) / 2.0};
  const double a = r.width() / 2.0, b = r.height() / 2.0;
  guess.shape_px2 = Eigen::Vector2d(a * a, b * b).asDiagonal();
  return guess;
}

bool IsDisc(const DetectedDisc& disc, const DiscDetectorOptions& options) {
  const double major = disc.ellipse.SemiMajor(), minor = disc.ellipse.SemiMinor();
  return disc.amplitude >= options.min_contrast && minor >= options.min_radius_px &&
         major <= options.max_radius_px && minor >= options.min_axis_ratio * major &&
         disc.residual <= kUsualNoise + options.max_misfit * disc.amplitude;
}

std::optional<DetectedDisc> Measure(const GreyImage& image, const BrightRegion& region) {
  // The second pass has the window in the right place and of the right shape.
  std::optional<DetectedDisc> moments = MeasureMoments(image, FirstGuess(region));
  if (moments) moments = MeasureMoments(image, moments->ellipse);
  if (!moments) return std::nullopt;
  return FitDisc(image, *moments);
}

}  // namespace

std::vector<DetectedDisc> DetectDiscs(const GreyImage& image, const DiscDetectorOptions& options) {
  std::vector<DetectedDisc> discs;
  for (const BrightRegion& region : FindBrightRegions(image, options.min_contrast)) {
    if (!Plausible(region, options)) continue;
    const std::optional<DetectedDisc> disc = Measure(image, region);
    if (disc && IsDisc(*disc, options)) discs.push_back(*disc);
  }
  std::sort(discs.begin(), discs.end(),
            [](const auto& a, const auto& b) { return a.ellipse.Area() > b.ellipse.Area(); });
  if (discs.size() > static_cast<std::size_t>(options.max_discs)) discs.resize(options.max_discs);
  return discs;
}

}  // namespace priamos::head
