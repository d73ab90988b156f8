#pragma once

#include <vector>

#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "head/core/calibration/discs/disc_projection.hpp"

namespace priamos::support {

/// How a camera turns light into grey levels.
struct Exposure {
  double blur_sigma_px = 0.7;  ///< Gaussian of the lens
  double noise_sigma = 2;      ///< grey levels, before rounding
};

/// Draws bright discs by exact area sampling: the share of a (sub)pixel that the projected ellipse covers is
/// computed in closed form, so that a centroid's error is the detector's alone. Blur and noise come after.
class DiscRenderer {
 public:
  /// `subpixels` per pixel and axis: with 1 the lens blur acts on pixels, with more also within them.
  DiscRenderer(int width, int height, double background, int subpixels = 2);

  /// Adds `amplitude` within the ellipse (undistorted pixels are pixels here).
  void AddEllipse(const head::Ellipse& ellipse, double amplitude);
  /// Adds the disc as the camera sees it, distortion included; false if it is not wholly before the camera.
  bool AddDisc(const head::CameraModel& camera, const ReferenceDisc& disc, double amplitude);
  /// Adds `amplitude` within an axis-parallel rectangle, corners in pixels.
  void AddRectangle(double u0, double v0, double u1, double v1, double amplitude);
  /// Hides what lies behind an axis-parallel rectangle: the light there becomes `level`.
  void Cover(double u0, double v0, double u1, double v1, double level);
  /// Adds a linear change of brightness: `per_px` times the distance from the image centre.
  void AddSlope(const Eigen::Vector2d& per_px);

  /// Blur, sampling, noise, rounding, clamping to 0..255.
  GreyImage Expose(const Exposure& exposure, Rng& rng) const;

 private:
  template <class Change>
  void Fill(const Eigen::Vector2d& low_px, const Eigen::Vector2d& high_px, const Change& change);
  /// The share of the subpixel at px that lies within the rectangle.
  double RectangleShare(const Eigen::Vector2d& px, const Eigen::Vector2d& low,
                        const Eigen::Vector2d& high) const;
  /// Pixel coordinate of the centre of subpixel column or row i.
  double Centre(int i) const { return (i + 0.5) / subpixels_ - 0.5; }

  int width_, height_, subpixels_;
  std::vector<float> light_;  ///< of every subpixel, row by row
};

/// The share of the convex quadrilateral `corners` that lies within the ellipse, in closed form.
double CoveredShare(const head::Ellipse& ellipse, const Eigen::Matrix<double, 2, 4>& corners);

}  // namespace priamos::support
