#pragma once

#include <Eigen/Core>
#include <string>

#include "common/outcome.hpp"

namespace priamos::head {

/// The 11 physical parameters of section 3.1.1 of the paper that a DLT matrix contains (Melen, 1993).
struct CameraParameters {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< optical centre C
  /// Directions of the camera (x right, y down, z forward) in the frame of the DLT matrix.
  Eigen::Matrix3d camera_from_base = Eigen::Matrix3d::Identity();
  double focal_u_px = 0, focal_v_px = 0;  ///< c/du and c/dv
  Eigen::Vector2d principal_px{0, 0};     ///< centre of the image plane H
  double axes_angle_rad = 0;              ///< between the image axes, pi/2 for a straight chip

  /// Rotations about x, y and z (in this order, radians) that make up camera_from_base.
  Eigen::Vector3d OmegaPhiKappa() const;
  /// Camera matrix: c/du, c/dv, skew and principal point H as an upper triangular matrix [px].
  Eigen::Matrix3d Intrinsics() const;
  /// The DLT matrix again, third row of direction length 1.
  Eigen::Matrix<double, 3, 4> Matrix() const;
  /// One line per parameter, for a person.
  std::string ToText() const;
};

/// RQ decomposition of the left 3x3 part. Refuses a matrix whose camera is at infinity or mirrored.
Outcome<CameraParameters> ExtractParameters(const Eigen::Matrix<double, 3, 4>& image_from_base);

}  // namespace priamos::head
