#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/frame_store.hpp"

namespace priamos::head {

/// A point of the laser's line in an image.
struct StripePoint {
  Eigen::Vector2d at;   ///< u is a whole column, v sub-pixel [distorted px]
  double contrast = 0;  ///< brightness over that above and below the line [grey levels]
  double sigma_px = 0;  ///< standard deviation of v, from the noise of the image
};

/// Limits within which a ridge of brightness counts as the line of the laser.
struct StripeOptions {
  double min_contrast = 18;  ///< least contrast [grey levels]
  int reach_px = 7;          ///< distance from the middle of the line to where it has faded
  double max_step_px = 2;    ///< largest step between neighbouring columns of one line
  int min_length_px = 12;    ///< shorter pieces are left out as reflections
  int smooth_px = 2;  ///< columns to either side that a place is the mean of; fewer at the ends of a piece
};

/// The line of a laser that runs across the image, roughly level (up to 45 degrees): at most one point per
/// column, the brightest ridge of it, sub-pixel by the maximum of the smoothed grey values (Steger, 1998)
/// over a sloping ground. An edge is no ridge, however strong. Pieces shorter than `min_length_px` are left
/// out. Grain of the surface and speckle differ from column to column: a place is the mean over symmetric
/// neighbours, which leaves a straight line where it is.
class StripeFinder {
 public:
  explicit StripeFinder(const StripeOptions& options = {}) : options_(options) {}

  /// Points by ascending column; none for an image with too few rows for a line.
  std::vector<StripePoint> Find(const GreyImage& image);

 private:
  void FindRidges(const GreyImage& image);
  void DropGlints(std::vector<StripePoint>& points) const;
  void Smooth(std::vector<StripePoint>& points) const;

  StripeOptions options_;
  std::vector<std::uint8_t> strength_, row_group_;  ///< best ridge of every column: contrast, and about where
  int rows_per_group_ = 1;
};

}  // namespace priamos::head
