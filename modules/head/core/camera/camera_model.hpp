#pragma once

#include <Eigen/Core>

#include "common/image_size.hpp"

namespace priamos::head {

/// One calibrated camera at one head setup: the DLT matrix of equations 1-6 of the paper and the lens
/// distortion to undo before it is used.
struct CameraModel {
  /// Maps homogeneous points of the base frame [m] to homogeneous undistorted pixels (u right, v down,
  /// (0,0) the centre of the top left pixel).
  Eigen::Matrix<double, 3, 4> image_from_base = Eigen::Matrix<double, 3, 4>::Zero();
  /// Radial distortion about `centre_px`: distorted - centre = (undistorted - centre) * (1 + k1 r^2 + k2
  /// r^4), r = |undistorted - centre| / scale_px.
  Eigen::Vector2d centre_px = ImageSize{}.Centre();
  double scale_px = 1000;
  double k1 = 0, k2 = 0;

  /// Undistorted image of a point (equations 5 and 6) [px]; the point must lie before the camera (see Depth).
  Eigen::Vector2d Project(const Eigen::Vector3d& in_base) const;
  /// Third homogeneous coordinate, positive before the camera when the matrix is normalised.
  double Depth(const Eigen::Vector3d& in_base) const;
  Eigen::Vector2d Distort(const Eigen::Vector2d& undistorted_px) const;
  Eigen::Vector2d Undistort(const Eigen::Vector2d& distorted_px) const;
};

}  // namespace priamos::head
