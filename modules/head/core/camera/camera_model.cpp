#include "head/core/camera/camera_model.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace priamos::head {

namespace {

/// The distorted radius that belongs to the undistorted radius r, both in units of scale_px.
double DistortedRadius(double r, double k1, double k2) {
  return r * (1 + r * r * (k1 + r * r * k2));
}
double DistortedRadiusSlope(double r, double k1, double k2) {
  return 1 + r * r * (3 * k1 + r * r * 5 * k2);
}

}  // namespace

Eigen::Vector2d CameraModel::Project(const Eigen::Vector3d& in_base) const {
  return (image_from_base * in_base.homogeneous()).hnormalized();
}

double CameraModel::Depth(const Eigen::Vector3d& in_base) const {
  return image_from_base.row(2).dot(in_base.homogeneous());
}

Eigen::Vector2d CameraModel::Distort(const Eigen::Vector2d& undistorted_px) const {
  const Eigen::Vector2d d = undistorted_px - centre_px;
  const double r2 = d.squaredNorm() / (scale_px * scale_px);
  return centre_px + d * (1 + r2 * (k1 + r2 * k2));
}

Eigen::Vector2d CameraModel::Undistort(const Eigen::Vector2d& distorted_px) const {
  const Eigen::Vector2d d = distorted_px - centre_px;
  const double target = d.norm() / scale_px;
  if (target == 0) return distorted_px;
  double r = target;
  for (int i = 0; i < 20; ++i) {
    const double slope = DistortedRadiusSlope(r, k1, k2);
    // Beyond the turning point of the polynomial no inverse exists; the last radius is the best answer.
    if (slope < 0.1) break;
    const double step = (DistortedRadius(r, k1, k2) - target) / slope;
    r -= step;
    if (std::abs(step) < 1e-13) break;
  }
  return centre_px + d * (r / target);
}

}  // namespace priamos::head
