#include "head/core/calibration/resection/camera_parameters.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d CameraParameters::OmegaPhiKappa() const {
  const Matrix3d& r = camera_from_base;
  return {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
          std::atan2(-r(0, 1), r(0, 0))};
}

Matrix3d CameraParameters::Intrinsics() const {
  Matrix3d k = Matrix3d::Identity();
  const double fv = focal_v_px / std::sin(axes_angle_rad);
  k << focal_u_px, -focal_u_px / std::tan(axes_angle_rad), principal_px.x(), 0, fv, principal_px.y(), 0, 0, 1;
  return k;
}

Eigen::Matrix<double, 3, 4> CameraParameters::Matrix() const {
  Eigen::Matrix<double, 3, 4> m;
  m.leftCols<3>() = Intrinsics() * camera_from_base;
  m.col(3) = -m.leftCols<3>() * centre_m;
  return m;
}

std::string CameraParameters::ToText() const {
  const Vector3d angles = OmegaPhiKappa();
  return fmt::format(
      "optical centre C      {:9.4f} {:9.4f} {:9.4f} m\n"
      "omega phi kappa       {:9.4f} {:9.4f} {:9.4f} deg\n"
      "focal length c/du, c/dv {:9.3f} {:9.3f} px\n"
      "image centre H        {:9.3f} {:9.3f} px\n"
      "angle between axes    {:9.5f} deg\n",
      centre_m.x(), centre_m.y(), centre_m.z(), Degrees(angles.x()), Degrees(angles.y()), Degrees(angles.z()),
      focal_u_px, focal_v_px, principal_px.x(), principal_px.y(), Degrees(axes_angle_rad));
}

Outcome<CameraParameters> ExtractParameters(const Eigen::Matrix<double, 3, 4>& image_from_base) {
  const double scale = image_from_base.block<1, 3>(2, 0).norm();
  if (!image_from_base.allFinite() || !(scale > 0)) return Refusal{"the matrix is a camera at infinity"};
  const Matrix3d m = image_from_base.leftCols<3>() / scale;
  // A left-handed matrix may also be a right one with the wrong sign; NormaliseDepth has settled that.
  if (!(m.determinant() > 0)) return Refusal{"the matrix is singular or mirrors the image"};
  CameraParameters p;
  const Vector3d m1 = m.row(0), m2 = m.row(1), m3 = m.row(2);
  // Rows of K R from the bottom: r3 = m3; the rest by successive projection (RQ in closed form).
  p.principal_px = {m1.dot(m3), m2.dot(m3)};
  const Vector3d rest2 = m2 - p.principal_px.y() * m3;
  const double k22 = rest2.norm();
  const Vector3d r2 = rest2 / k22;
  const double skew = m1.dot(r2);
  const Vector3d r1 = r2.cross(m3);
  p.focal_u_px = m1.dot(r1);
  p.camera_from_base << r1.transpose(), r2.transpose(), m3.transpose();
  p.axes_angle_rad = std::atan2(p.focal_u_px, -skew);
  p.focal_v_px = k22 * std::sin(p.axes_angle_rad);
  p.centre_m = -m.inverse() * image_from_base.col(3) / scale;
  return p;
}

}  // namespace priamos::head
