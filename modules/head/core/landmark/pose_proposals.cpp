#include "head/core/landmark/pose_proposals.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

/// A vertical model edge on the floor, with the reconstructed edges it could be.
struct ModelVertical {
  Eigen::Vector2d at;
  double z_min, z_max;
  std::vector<int> candidates;
};

/// A pose error moves a point at `lever` from the origin of the landmark.
Eigen::Matrix2d PointCovariance(const Eigen::Matrix3d& pose, const Eigen::Vector2d& lever) {
  Eigen::Matrix<double, 2, 3> j;
  j << 1, 0, -lever.y(), 0, 1, lever.x();
  return j * pose * j.transpose();
}

std::vector<ModelVertical> FindCandidates(const LandmarkModel& model, std::span<const int> visible,
                                          std::span<const VerticalEdge> verticals, const Pose2& predicted,
                                          const Eigen::Matrix3d& covariance, double gate) {
  std::vector<ModelVertical> result;
  for (const int index : visible) {
    const LandmarkEdge& edge = model.edges[index];
    if (!edge.IsVertical()) continue;
    ModelVertical vertical{
        edge.from.head<2>(), std::min(edge.from.z(), edge.to.z()), std::max(edge.from.z(), edge.to.z()), {}};
    const Eigen::Vector2d there = predicted * vertical.at;
    const Eigen::Matrix2d spread = PointCovariance(covariance, predicted.rotation() * vertical.at);
    for (std::size_t i = 0; i < verticals.size(); ++i) {
      const VerticalEdge& v = verticals[i];
      const Eigen::Vector2d d = v.at - there;
      const Eigen::Matrix2d s = spread + v.covariance;
      if (d.dot(s.inverse() * d) > gate * gate) continue;
      const double common = std::min(v.z_max_m, vertical.z_max) - std::max(v.z_min_m, vertical.z_min);
      if (common < 0.5 * (v.z_max_m - v.z_min_m)) continue;
      vertical.candidates.push_back(static_cast<int>(i));
    }
    result.push_back(std::move(vertical));
  }
  return result;
}

/// The pose that lays the model's points a, b onto p, q, the middle exactly.
Pose2 Lay(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p,
          const Eigen::Vector2d& q) {
  const Eigen::Vector2d model = b - a, seen = q - p;
  Pose2 pose{0, 0, WrapAngle(std::atan2(seen.y(), seen.x()) - std::atan2(model.y(), model.x()))};
  const Eigen::Vector2d t = (p + q) / 2 - pose.rotation() * ((a + b) / 2);
  pose.x = t.x();
  pose.y = t.y();
  return pose;
}

void Merge(std::vector<PoseProposal>& poses, const Pose2& pose, const ProposalOptions& options) {
  for (PoseProposal& p : poses) {
    if ((p.base_from_landmark.translation() - pose.translation()).norm() < options.merge_m &&
        std::abs(WrapAngle(p.base_from_landmark.yaw - pose.yaw)) < options.merge_rad) {
      ++p.support;
      return;
    }
  }
  poses.push_back({pose, 1});
}

}  // namespace

double SquaredDistance(const Pose2& a, const Pose2& b, const Eigen::Matrix3d& covariance) {
  const Eigen::Vector3d d(a.x - b.x, a.y - b.y, WrapAngle(a.yaw - b.yaw));
  return d.dot(covariance.ldlt().solve(d));
}

Proposals ProposePoses(const LandmarkModel& model, std::span<const int> visible,
                       std::span<const VerticalEdge> verticals, const Pose2& predicted,
                       const Eigen::Matrix3d& covariance, const ProposalOptions& options) {
  const auto edges = FindCandidates(model, visible, verticals, predicted, covariance, options.gate);
  const Eigen::Matrix3d information = covariance.inverse();
  Proposals proposals;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const double base = (edges[i].at - edges[j].at).norm();
      if (base < options.min_base_m) continue;
      for (const int a : edges[i].candidates) {
        for (const int b : edges[j].candidates) {
          const VerticalEdge &p = verticals[a], &q = verticals[b];
          if (p.left == q.left || p.right == q.right) continue;
          const Eigen::Vector2d direction = q.at - p.at, unit = direction.normalized();
          const double error = std::abs(direction.norm() - base);
          if (error > options.max_distance_error_m) {
            const double variance = unit.dot((p.covariance + q.covariance) * unit);
            if (error > options.max_distance_error_m + 3 * std::sqrt(variance)) continue;
          }
          const Pose2 pose = Lay(edges[i].at, edges[j].at, p.at, q.at);
          const Eigen::Vector3d d(pose.x - predicted.x, pose.y - predicted.y,
                                  WrapAngle(pose.yaw - predicted.yaw));
          if (d.dot(information * d) > options.gate * options.gate) continue;
          ++proposals.n_tested;
          Merge(proposals.poses, pose, options);
        }
      }
    }
  }
  std::stable_sort(proposals.poses.begin(), proposals.poses.end(),
                   [](const PoseProposal& a, const PoseProposal& b) { return a.support > b.support; });
  if (proposals.poses.size() > std::size_t(options.max_proposals))
    proposals.poses.resize(options.max_proposals);
  return proposals;
}

}  // namespace priamos::head
