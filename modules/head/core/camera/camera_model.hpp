#pragma once

#include <Eigen/Core>

#include "common/image_size.hpp"

namespace priamos::head {

/// The rest of the lens model of OpenCV and ROS ("plumb_bob", "rational_polynomial"), in which
/// x = (u - centre) / scale, y = (v - centre) / (scale * aspect), and r^2 = x^2 + y^2:
/// x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2), and
/// y' = y (the same) + p1 (r^2 + 2 y^2) + 2 p2 x y.
struct LensBend {
  double k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  double p1 = 0, p2 = 0;
  double aspect = 1;  ///< focal length along v over that along u

  bool operator==(const LensBend&) const = default;
};

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
  LensBend bend{};  ///< what a lens does beyond that; cameras that were calibrated here have none

  /// Undistorted image of a point (equations 5 and 6) [px]; the point must lie before the camera (see Depth).
  Eigen::Vector2d Project(const Eigen::Vector3d& in_base) const;
  /// Third homogeneous coordinate, positive before the camera when the matrix is normalised.
  double Depth(const Eigen::Vector3d& in_base) const;
  /// True where distortion depends on the distance from `centre_px` alone.
  bool IsRadial() const { return bend == LensBend(); }
  Eigen::Vector2d Distort(const Eigen::Vector2d& undistorted_px) const;
  Eigen::Vector2d Undistort(const Eigen::Vector2d& distorted_px) const;
};

}  // namespace priamos::head
