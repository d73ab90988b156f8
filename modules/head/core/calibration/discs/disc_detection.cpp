#include "head/core/calibration/discs/disc_detection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/geometry.hpp"
#include "head/core/calibration/discs/bright_regions.hpp"

namespace priamos::head {

namespace {

constexpr int kReach_px = 8;       // of the window around a spot
constexpr double kFade_px = 1.5;   // where the rim of another spot has faded
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

/// What the fit must not take for its own rim: the spots whose boxes are within reach of the region's.
std::vector<Ellipse> Neighbours(const std::vector<BrightRegion>& regions, std::size_t self) {
  std::vector<Ellipse> others;
  const BrightRegion& r = regions[self];
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const BrightRegion& o = regions[i];
    const int du = std::max(o.u_min - r.u_max, r.u_min - o.u_max);
    const int dv = std::max(o.v_min - r.v_max, r.v_min - o.v_max);
    // Boxes that overlap belong to something that winds around the region; an ellipse does not describe it.
    const bool near = std::max(du, dv) > 0 && std::max(du, dv) <= kReach_px;
    if (i == self || !near) continue;
    Ellipse other = FirstGuess(o);
    const Eigen::Vector2d half(o.width() / 2.0 + kFade_px, o.height() / 2.0 + kFade_px);
    other.shape_px2 = half.cwiseAbs2().asDiagonal();
    others.push_back(other);
  }
  return others;
}

std::optional<DetectedDisc> Measure(const GreyImage& image, const BrightRegion& region,
                                    const std::vector<Ellipse>& others) {
  const std::optional<DetectedDisc> moments = MeasureMoments(image, FirstGuess(region), others);
  if (!moments) return std::nullopt;
  return FitDisc(image, *moments, others);
}

}  // namespace

std::vector<DetectedDisc> DetectDiscs(const GreyImage& image, const DiscDetectorOptions& options) {
  std::vector<DetectedDisc> discs;
  // Only spots of a disc's size are measured, and only they can be separated from a disc close by.
  std::vector<BrightRegion> regions = FindBrightRegions(image, options.min_contrast);
  std::erase_if(regions, [&](const BrightRegion& r) { return !Plausible(r, options); });
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const std::optional<DetectedDisc> disc = Measure(image, regions[i], Neighbours(regions, i));
    if (disc && IsDisc(*disc, options)) discs.push_back(*disc);
  }
  std::sort(discs.begin(), discs.end(),
            [](const auto& a, const auto& b) { return a.ellipse.Area() > b.ellipse.Area(); });
  if (discs.size() > static_cast<std::size_t>(options.max_discs)) discs.resize(options.max_discs);
  return discs;
}

}  // namespace priamos::head
