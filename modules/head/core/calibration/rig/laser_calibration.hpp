#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "common/outcome.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/floor/laser_stripe.hpp"

namespace priamos::head {

/// The laser's line on a board or a floor whose place is known, in one image.
struct StripeView {
  CameraModel camera;                  ///< at the exposure, in the base frame
  Eigen::Hyperplane<double, 3> board;  ///< in the base frame
  std::vector<StripePoint> points;
  double board_sigma_m = 0.0005;  ///< placement error of the board along its normal
};

/// The plane of the laser's light and how well it explains the lines.
struct LaserCalibration {
  LaserPlane plane;
  int points = 0, outliers = 0;      ///< number of points used, and of those left out as other bright lines
  double rms_px = 0;                 ///< RMS residual of the points used
  std::vector<double> view_rms_px;   ///< RMS residual of the points used, of each view
  std::vector<double> residuals_px;  ///< measured minus computed row of every point, view after view
};

/// Fits the plane of light to the points in which the lines of sight meet the boards: a first plane by
/// consensus, then least squares of the distance in the image without the points that belong to other bright
/// lines. The standard deviations count the errors of a view as common to all its points, because what is
/// wrong about a board's place is: `board_sigma_m`, or what the residuals of the lines show if that is more.
///
/// Refuses numbers that are not finite, a board that is seen edge-on or lies behind the camera, too few
/// points, lines that (nearly) are one straight line of space, as those of all pictures of one floor are, and
/// points that no plane explains.
Outcome<LaserCalibration> CalibrateLaserPlane(std::span<const StripeView> views);

}  // namespace priamos::head
