#include "head/core/prediction.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr double kNearDepth = 0.1;  ///< [m] nothing nearer is imaged
constexpr double kMinLengthPx = 8;

/// Cuts the segment from + f * (to - from), f in [begin, end], to the half space where `value` grows from
/// `at_from` to `at_to` and is positive. False if nothing is left.
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

Eigen::Vector3d PredictedEdge::PointAt(const Eigen::Vector2d& image) const {
  const Eigen::Vector2d way = q - p;
  const double s = way.dot(image - p) / way.squaredNorm();
  // Equal steps in the image are unequal steps in space.
  const double along = s * depth_p / (s * depth_p + (1 - s) * depth_q);
  return in_base_p + along * (in_base_q - in_base_p);
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

Eigen::Matrix<double, 3, 6> PoseJacobian(const Eigen::Isometry3d& base_from_landmark,
                                         const Eigen::Vector3d& in_base) {
  const Eigen::Vector3d r = in_base - base_from_landmark.translation();
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian.leftCols<3>().setIdentity();
  jacobian.rightCols<3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return jacobian;
}

std::optional<PredictedEdge> ProjectEdge(const CameraModel& camera, const ImageSize& size,
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
  PredictedEdge edge;
  edge.p = p.hnormalized(), edge.q = q.hnormalized();
  edge.depth_p = p.z(), edge.depth_q = q.z();
  edge.p_is_end = begin == 0, edge.q_is_end = end == 1;
  edge.in_base_p = from_in_base + begin * (to_in_base - from_in_base);
  edge.in_base_q = from_in_base + end * (to_in_base - from_in_base);
  if (edge.length_px() < kMinLengthPx) return std::nullopt;
  return edge;
}

std::vector<PredictedEdge> PredictEdges(const LandmarkModel& model, const Pose2& base_from_landmark,
                                        const Eigen::Matrix3d& covariance, const CameraModel& camera,
                                        const ImageSize& size) {
  const Eigen::Isometry3d transform = Lift(base_from_landmark);
  const Eigen::Vector2d viewer = base_from_landmark.Inverse().translation();
  const double spread =
      std::sqrt(std::max(covariance(0, 0), covariance(1, 1))) / std::max(viewer.norm(), 0.3) +
      std::sqrt(covariance(2, 2));
  std::vector<PredictedEdge> predicted;
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    const LandmarkEdge& edge = model.edges[i];
    if (!edge.IsSeenFrom(viewer, spread)) continue;
    auto view = ProjectEdge(camera, size, transform * edge.from, transform * edge.to);
    if (!view) continue;
    view->edge = static_cast<int>(i);
    for (const Eigen::Vector3d& point : {view->in_base_p, view->in_base_q}) {
      const Eigen::Matrix<double, 3, 6> pose = PoseJacobian(transform, point);
      Eigen::Matrix3d floor;
      floor << pose.col(0), pose.col(1), pose.col(5);
      const Eigen::RowVector3d across =
          view->normal().transpose() * ProjectionJacobian(camera, point) * floor;
      view->search_px = std::max(view->search_px, std::sqrt(across * covariance * across.transpose()));
    }
    predicted.push_back(*view);
  }
  return predicted;
}

}  // namespace priamos::head
