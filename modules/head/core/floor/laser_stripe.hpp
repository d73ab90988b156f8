#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/frame_store.hpp"

namespace priamos::head {

/// A point of the laser's line in an image.
struct StripePoint {
  Eigen::Vector2d at;                ///< u is a whole column, v sub-pixel [distorted px]
  double contrast = 0;               ///< brightness over that above and below the line [grey levels]
  double sigma_px = 0;               ///< standard deviation of v, from the noise of the image
  double least_contrast = contrast;  ///< over the brighter side
};

/// Limits within which a ridge of brightness counts as the line of the laser.
struct StripeOptions {
  double min_contrast = 18;  ///< least contrast [grey levels]
  double min_share = 0.25;   ///< of the contrast of most of the line: a fainter ridge is something else
  int reach_px = 7;          ///< distance from the middle of the line to where it has faded
  double max_step_px = 2;    ///< largest step between neighbouring columns of one line
  int min_length_px = 12;    ///< shorter pieces are left out as reflections
  int smooth_px = 2;  ///< columns to either side that a place is the mean of; fewer at the ends of a piece
};

/// Lines of lasers that run across the image, roughly level (up to 45 degrees): the brightest ridges of each
/// column, sub-pixel by the maximum of the smoothed grey values (Steger, 1998) over a sloping ground. An edge
/// is no ridge, however strong. Pieces shorter than `min_length_px` are left out. Grain of the surface and
/// speckle differ from column to column: a place is the mean over symmetric neighbours, which leaves a
/// straight line where it is.
class StripeFinder {
 public:
  explicit StripeFinder(const StripeOptions& options = {}) : options_(options) {}

  /// The only line, at most one point per column, by ascending column; none for an image with too few rows.
  std::vector<StripePoint> Find(const GreyImage& image) { return Trace(Ridges(image, 1)); }
  /// `n` lines, from the top of the image to its bottom: of the columns in which there are as many ridges.
  std::vector<std::vector<StripePoint>> FindInOrder(const GreyImage& image, int n);

  /// The `most` brightest ridges of every column, by ascending column and row, as they are. They lie
  /// `reach_px` and more apart.
  std::vector<StripePoint> Ridges(const GreyImage& image, int most);
  /// The line among the ridges, one per column: without glints, smoothed.
  std::vector<StripePoint> Trace(std::vector<StripePoint> ridges) const;

 private:
  struct RidgeAt {
    StripePoint point;
    double roughness;
  };
  void FindRidges(const GreyImage& image, int most);
  std::size_t Strongest(int width, int u) const;
  void Measure(const GreyImage& image, int u, std::uint8_t group, std::vector<RidgeAt>& found) const;
  void DropFaint(std::vector<StripePoint>& points) const;
  void DropGlints(std::vector<StripePoint>& points) const;
  void Smooth(std::vector<StripePoint>& points) const;

  StripeOptions options_;
  /// Best ridge of every column and slab of rows: contrast, and about where.
  std::vector<std::uint8_t> strength_, row_group_;
  int slabs_ = 1, rows_per_group_ = 1;
};

}  // namespace priamos::head
