#include "head/core/camera/laser_plane.hpp"

#include <Eigen/LU>
#include <cmath>

namespace priamos::head {

namespace {

constexpr double kEdgeOn = 0.02;  // sine of the flattest angle between line of sight and plane

}  // namespace

Eigen::Hyperplane<double, 3> LaserPlane::InCamera(const Eigen::Isometry3d& base_from_camera) const {
  const Eigen::Vector3d turned = base_from_camera.linear().transpose() * normal;
  return {turned, offset_m + normal.dot(base_from_camera.translation())};
}

std::optional<Eigen::Vector3d> PointOnPlane(const CameraModel& camera, const Eigen::Vector2d& image_px,
                                            const Eigen::Hyperplane<double, 3>& plane) {
  const Eigen::Matrix3d inverse = camera.image_from_base.leftCols<3>().inverse();
  const Eigen::Vector3d eye = -inverse * camera.image_from_base.col(3);
  const Eigen::Vector3d ray = (inverse * camera.Undistort(image_px).homogeneous()).normalized();
  const double slope = plane.normal().dot(ray);
  if (!(std::abs(slope) > kEdgeOn)) return std::nullopt;  // also for what is no number
  const Eigen::Vector3d point = eye - plane.signedDistance(eye) / slope * ray;
  return camera.Depth(point) > 0 ? std::optional(point) : std::nullopt;
}

}  // namespace priamos::head
