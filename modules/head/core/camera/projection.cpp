#include "head/core/camera/projection.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace priamos::head {
namespace {

constexpr double kNearDepth = 0.1;  ///< [m] nothing nearer is imaged
constexpr double kMinLength_px = 8;

/// Cuts the segment from + f * (to - from), f in [begin, end], to where a value that is
/// linear along it, `at_from` at its beginning and `at_to` at its end, is positive. False if nothing is left.
bool Cut(double at_from, double at_to, double& begin, double& end) {
  if (at_from < 0 && at_to < 0) return false;
  if (at_from >= 0 && at_to >= 0) return true;
  const double zero = at_from / (at_from - at_to);
  if (at_from < 0) {
    begin = std::max(begin, zero);
  } else {
    end = std::min(end, zero);
  }
  return begin < end;
}

}  // namespace

Eigen::Vector3d ProjectedEdge::PointAt(const Eigen::Vector2d& image) const {
  const Eigen::Vector2d delta = q - p;
  const double s = delta.dot(image - p) / delta.squaredNorm();
  // Equal steps in the image are unequal steps in space.
  const double along = s * depth_p / (s * depth_p + (1 - s) * depth_q);
  return in_base_p + along * (in_base_q - in_base_p);
}

std::optional<ProjectedEdge> ProjectEdge(const CameraModel& camera, const ImageSize& size,
                                         const Eigen::Vector3d& from_in_base,
                                         const Eigen::Vector3d& to_in_base) {
  const Eigen::Vector3d a = camera.image_from_base * from_in_base.homogeneous();
  const Eigen::Vector3d b = camera.image_from_base * to_in_base.homogeneous();
  // All borders are planes through the optical centre, so cutting is linear in space.
  double begin = 0, end = 1;
  const double right = size.width - 1, bottom = size.height - 1;
  if (!Cut(a.z() - kNearDepth, b.z() - kNearDepth, begin, end) || !Cut(a.x(), b.x(), begin, end) ||
      !Cut(right * a.z() - a.x(), right * b.z() - b.x(), begin, end) || !Cut(a.y(), b.y(), begin, end) ||
      !Cut(bottom * a.z() - a.y(), bottom * b.z() - b.y(), begin, end)) {
    return std::nullopt;
  }
  const Eigen::Vector3d p = a + begin * (b - a), q = a + end * (b - a);
  ProjectedEdge edge;
  edge.p = p.hnormalized();
  edge.q = q.hnormalized();
  edge.depth_p = p.z();
  edge.depth_q = q.z();
  edge.p_is_end = begin == 0;
  edge.q_is_end = end == 1;
  edge.in_base_p = from_in_base + begin * (to_in_base - from_in_base);
  edge.in_base_q = from_in_base + end * (to_in_base - from_in_base);
  if (edge.length_px() < kMinLength_px) return std::nullopt;
  return edge;
}

Eigen::Matrix<double, 2, 3> ProjectionJacobian(const CameraModel& camera, const Eigen::Vector3d& in_base) {
  const Eigen::Vector3d h = camera.image_from_base * in_base.homogeneous();
  Eigen::Matrix<double, 2, 3> jacobian;
  for (int i = 0; i < 2; ++i) {
    jacobian.row(i) =
        (camera.image_from_base.row(i).head<3>() - h[i] / h[2] * camera.image_from_base.row(2).head<3>()) /
        h[2];
  }
  return jacobian;
}

Eigen::Vector3d OpticalCentre(const CameraModel& camera) {
  return -camera.image_from_base.leftCols<3>().inverse() * camera.image_from_base.col(3);
}

}  // namespace priamos::head
