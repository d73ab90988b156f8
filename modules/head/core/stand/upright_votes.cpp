#include "head/core/stand/upright_votes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace priamos::head {
namespace {

UprightVote VoteOf(const CameraView& view, const ViewLine& line, double capped_px) {
  const EdgeSegment& segment = view.edges->segments[line.segment];
  const Eigen::Vector2d direction = (line.q - line.p) / line.length_px, centre = (line.p + line.q) / 2;
  const Eigen::Matrix3d to_base = view.camera->image_from_base.leftCols<3>().transpose();
  const double scale =
      1 / (to_base * Eigen::Vector3d(line.normal.x(), line.normal.y(), -line.normal.dot(line.p))).norm();
  UprightVote vote;
  vote.normal = line.plane.head<3>();
  vote.noise[0] = to_base * Eigen::Vector3d(0, 0, segment.sigma_normal_px) * scale;
  vote.noise[1] = to_base * Eigen::Vector3d(direction.x(), direction.y(), -direction.dot(centre)) *
                  (segment.sigma_angle_rad * scale);
  vote.weight = std::min(line.length_px, capped_px);
  return vote;
}

std::vector<UprightVote> Edges(std::span<const CameraView> views, const UprightOptions& options,
                               bool are_steep) {
  std::vector<UprightVote> votes;
  const double slope = std::tan(options.max_slope_rad);
  for (const CameraView& view : views) {
    for (const ViewLine& line : view.lines) {
      const Eigen::Vector2d d = line.q - line.p;
      if (!(line.length_px >= options.min_length_px)) continue;
      if ((std::abs(d.x()) <= slope * std::abs(d.y())) != are_steep) continue;
      const UprightVote vote = VoteOf(view, line, options.capped_length_px);
      if (vote.normal.allFinite() && vote.noise[0].allFinite() && vote.noise[1].allFinite())
        votes.push_back(vote);
    }
  }
  std::stable_sort(votes.begin(), votes.end(),
                   [](const UprightVote& a, const UprightVote& b) { return a.weight > b.weight; });
  return votes;
}

}  // namespace

double UprightVote::Sigma(const Eigen::Vector3d& direction) const {
  return std::hypot(noise[0].dot(direction), noise[1].dot(direction));
}

std::vector<UprightVote> SteepEdges(std::span<const CameraView> views, const UprightOptions& options) {
  return Edges(views, options, true);
}

std::vector<UprightVote> OtherEdges(std::span<const CameraView> views, const UprightOptions& options) {
  return Edges(views, options, false);
}

}  // namespace priamos::head
