#pragma once

#include <Eigen/Geometry>

#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::support {

using Plane = Eigen::Hyperplane<double, 3>;

/// A matt plane with a laser's line on it.
struct StripeScene {
  head::CameraModel camera;
  Plane laser, board;
  double thickness_m = 0.004;  ///< of the sheet of light, two sigma of its Gaussian profile
  double background = 40;      ///< grey level of the board
  double slope_per_px = 0;     ///< by which it grows from row to row
  double amplitude = 120;      ///< of the line
  double blur_px = 0.7;
  double noise = 2;
  int width = 768, height = 576;
};

/// The image by sampling every pixel at 3 x 3 places (the profile of the light is smooth).
GreyImage Render(const StripeScene& scene, Rng& rng);

/// Where the middle of the line truly is in column u [distorted px]: the board's point that lies in the plane
/// of the light; NaN where there is none in the image.
double StripeRow(const StripeScene& scene, double u);

}  // namespace priamos::support
