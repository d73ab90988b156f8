#include "head/core/landmark/prediction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace priamos::head {

Eigen::Matrix<double, 3, 6> PoseJacobian(const Eigen::Isometry3d& base_from_landmark,
                                         const Eigen::Vector3d& in_base) {
  const Eigen::Vector3d r = in_base - base_from_landmark.translation();
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian.leftCols<3>().setIdentity();
  jacobian.rightCols<3>() << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  return jacobian;
}

Eigen::Isometry3d Moved(Eigen::Isometry3d pose, const Eigen::Matrix<double, 6, 1>& step) {
  pose.translation() += step.head<3>();
  const Eigen::Vector3d turn = step.tail<3>();
  if (turn.norm() > 0)
    pose.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose.linear();
  return pose;
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
    const auto seen = ProjectEdge(camera, size, transform * edge.from, transform * edge.to);
    if (!seen) continue;
    PredictedEdge view{*seen, static_cast<int>(i)};
    for (const Eigen::Vector3d& point : {view.in_base_p, view.in_base_q}) {
      const Eigen::Matrix<double, 3, 6> pose = PoseJacobian(transform, point);
      Eigen::Matrix3d floor;
      floor << pose.col(0), pose.col(1), pose.col(5);
      const Eigen::RowVector3d across = view.normal().transpose() * ProjectionJacobian(camera, point) * floor;
      view.search_px = std::max(view.search_px, std::sqrt(across * covariance * across.transpose()));
    }
    predicted.push_back(view);
  }
  return predicted;
}

}  // namespace priamos::head
