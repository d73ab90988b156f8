#include "head/core/camera/camera_model.hpp"

#include <Eigen/Dense>
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

/// A point of the normalised image plane as the lens bends it, and the derivative of that.
struct Bent {
  Eigen::Vector2d at;
  Eigen::Matrix2d slope;
};

Bent Bend(const CameraModel& camera, const Eigen::Vector2d& p) {
  const LensBend& b = camera.bend;
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double above = 1 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * b.k3)),
               below = 1 + r2 * (b.k4 + r2 * (b.k5 + r2 * b.k6));
  const double above_slope = camera.k1 + r2 * (2 * camera.k2 + 3 * r2 * b.k3),
               below_slope = b.k4 + r2 * (2 * b.k5 + 3 * r2 * b.k6);
  const double stretch = above / below, by_r2 = (above_slope - stretch * below_slope) / below;
  Bent bent;
  bent.at = stretch * p + Eigen::Vector2d(2 * b.p1 * x * y + b.p2 * (r2 + 2 * x * x),
                                          b.p1 * (r2 + 2 * y * y) + 2 * b.p2 * x * y);
  bent.slope = stretch * Eigen::Matrix2d::Identity() + 2 * by_r2 * p * p.transpose();
  bent.slope(0, 0) += 2 * b.p1 * y + 6 * b.p2 * x;
  bent.slope(0, 1) += 2 * b.p1 * x + 2 * b.p2 * y;
  bent.slope(1, 0) += 2 * b.p1 * x + 2 * b.p2 * y;
  bent.slope(1, 1) += 6 * b.p1 * y + 2 * b.p2 * x;
  return bent;
}

/// The point that is bent to `target`, by Newton's method.
Eigen::Vector2d Unbend(const CameraModel& camera, const Eigen::Vector2d& target) {
  Eigen::Vector2d p = target;
  for (int i = 0; i < 20; ++i) {
    const Bent bent = Bend(camera, p);
    // Where the lens would fold the image no inverse exists; the last point is the best answer.
    if (!(bent.slope.determinant() > 0.01)) break;
    const Eigen::Vector2d step = bent.slope.inverse() * (bent.at - target);
    p -= step;
    if (step.squaredNorm() < 1e-26) break;
  }
  return p;
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
  if (!IsRadial()) {
    const Eigen::Array2d scale(scale_px, scale_px * bend.aspect);
    return centre_px + (scale * Bend(*this, d.array() / scale).at.array()).matrix();
  }
  const double r2 = d.squaredNorm() / (scale_px * scale_px);
  return centre_px + d * (1 + r2 * (k1 + r2 * k2));
}

Eigen::Vector2d CameraModel::Undistort(const Eigen::Vector2d& distorted_px) const {
  const Eigen::Vector2d d = distorted_px - centre_px;
  if (!IsRadial()) {
    const Eigen::Array2d scale(scale_px, scale_px * bend.aspect);
    return centre_px + (scale * Unbend(*this, d.array() / scale).array()).matrix();
  }
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
