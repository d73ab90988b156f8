#pragma once

#include <vector>

#include "head/core/calibration/discs/disc_fit.hpp"

namespace priamos::head {

/// What counts as a disc.
struct DiscDetectorOptions {
  int min_contrast = 25;         ///< grey levels between disc and surroundings
  double min_radius_px = 2.0;    ///< smallest semi-minor axis
  double max_radius_px = 90;     ///< largest semi-major axis
  double min_axis_ratio = 0.35;  ///< seen at up to 70 degrees from its normal
  double max_misfit = 0.03;      ///< RMS misfit of the ellipse model as a share of the contrast, beyond noise
  int max_discs = 200;           ///< the largest ones are kept
};

/// All bright ellipses of an image, largest first, centres with sub-pixel precision. Spots that are not
/// elliptic, half hidden, or cut by the image border are left out. Returns nothing for an empty image.
std::vector<DetectedDisc> DetectDiscs(const GreyImage& image, const DiscDetectorOptions& options = {});

}  // namespace priamos::head
