#include "head/core/landmark/edge_residual.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/landmark/prediction.hpp"

namespace priamos::head {
namespace {

constexpr double kNearDepth = 0.1;  ///< [m]
constexpr double kSamePlace_px = 0.5;

/// Least squares line through points of one edge.
ObservedLine Fit(std::span<const EdgeObservation> points) {
  ObservedLine line{points[0].edge, points[0].camera, 2, {}, 0};
  double w = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const EdgeObservation& o : points) {
    const double weight = 1 / (o.sigma_px * o.sigma_px);
    w += weight;
    centre += weight * o.at;
  }
  centre /= w;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const EdgeObservation& o : points) {
    const Eigen::Vector2d d = o.at - centre;
    scatter += d * d.transpose() / (o.sigma_px * o.sigma_px * w);
  }
  // Direction of the larger eigenvalue of a symmetric 2x2 matrix.
  const double angle = 0.5 * std::atan2(2 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  const double spread = std::sqrt(std::max(0.0, direction.dot(scatter * direction)));
  if (spread < kSamePlace_px) line.n = 1;
  line.at[0] = line.n == 1 ? centre : Eigen::Vector2d(centre - spread * direction);
  line.at[1] = centre + spread * direction;
  line.sigma_px = std::sqrt(line.n / w);
  return line;
}

/// The whole model edge in the image, uncut: points may lie a little beyond its ends.
std::optional<ProjectedEdge> Project(const CameraModel& camera, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to) {
  ProjectedEdge edge;
  edge.in_base_p = from;
  edge.in_base_q = to;
  edge.depth_p = camera.Depth(from);
  edge.depth_q = camera.Depth(to);
  if (edge.depth_p < kNearDepth && edge.depth_q < kNearDepth) return std::nullopt;
  if (edge.depth_p < kNearDepth || edge.depth_q < kNearDepth) {
    const double cut = (kNearDepth - edge.depth_p) / (edge.depth_q - edge.depth_p);
    (edge.depth_p < kNearDepth ? edge.in_base_p : edge.in_base_q) = from + cut * (to - from);
    (edge.depth_p < kNearDepth ? edge.depth_p : edge.depth_q) = kNearDepth;
  }
  edge.p = camera.Project(edge.in_base_p);
  edge.q = camera.Project(edge.in_base_q);
  if (edge.length_px() < 1) return std::nullopt;
  return edge;
}

}  // namespace

std::vector<ObservedLine> ObservedLines(std::span<const EdgeObservation> observations) {
  std::vector<ObservedLine> lines;
  for (std::size_t begin = 0; begin < observations.size();) {
    std::size_t end = begin + 1;
    while (end < observations.size() && observations[end].edge == observations[begin].edge &&
           observations[end].camera == observations[begin].camera) {
      ++end;
    }
    lines.push_back(Fit(observations.subspan(begin, end - begin)));
    begin = end;
  }
  return lines;
}

std::optional<EdgeResidual> ResidualOf(const CameraModel& camera, const Eigen::Isometry3d& base_from_landmark,
                                       const LandmarkEdge& edge, const Eigen::Vector2d& at) {
  const Eigen::Vector3d from = base_from_landmark * edge.from, to = base_from_landmark * edge.to;
  const auto view = Project(camera, from, to);
  if (!view) return std::nullopt;
  const Eigen::Vector2d normal = view->normal();
  const Eigen::Vector3d point = view->PointAt(at);
  const Eigen::RowVector3d in_space = normal.transpose() * ProjectionJacobian(camera, point);
  const Eigen::Vector3d along = (to - from).normalized();
  EdgeResidual residual;
  residual.distance_px = normal.dot(at - view->p);
  residual.by_pose = in_space * PoseJacobian(base_from_landmark, point);
  residual.by_base = in_space * PoseJacobian(Eigen::Isometry3d::Identity(), point);
  const Eigen::Vector2d arm = (at - camera.centre_px) / kCameraLever_px;
  residual.by_camera << normal, normal.dot(Eigen::Vector2d(-arm.y(), arm.x())), normal.dot(arm);
  residual.across = in_space.transpose() - along * in_space.dot(along);
  residual.lever = 2 * along.dot(point - from) / (to - from).norm() - 1;
  return residual;
}

}  // namespace priamos::head
