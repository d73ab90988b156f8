#include "head/core/look/far_edges.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "head/core/scene/upright_edges.hpp"

namespace priamos::head {
namespace {

/// A fix whose heading is not known better says too little of where the edges are.
constexpr double kMostSigma_rad = Radians(0.15);

/// Those matches whose edge runs up in the left image, or those that run down: the bright side is on the
/// right of the direction.
std::vector<StereoMatch> Running(const CameraView& left, std::span<const StereoMatch> matches, bool up) {
  std::vector<StereoMatch> some;
  for (const StereoMatch& match : matches) {
    const ViewLine& line = left.lines[static_cast<std::size_t>(match.left)];
    if (match.space && (line.q.y() < line.p.y()) == up) some.push_back(match);
  }
  return some;
}

UprightOptions OptionsOf(const FarEdgeOptions& options) {
  UprightOptions uprights;
  uprights.min_height_m = options.least_height_m;
  uprights.max_distance_m = options.most_m;
  uprights.max_sigma_m = options.most_share * options.most_m;
  return uprights;
}

/// Across the line of sight the place is known best, and that is what counts; `apart` is where b lies from a.
bool AreOne(const FarEdge& a, const FarEdge& b, const Eigen::Vector2d& viewer, double same_m) {
  if (a.bright_right != b.bright_right) return false;
  const Eigen::Vector2d sight = (a.at - viewer).normalized(), across(-sight.y(), sight.x()),
                        apart = b.at - a.at;
  const Eigen::Matrix2d both = a.covariance + b.covariance;
  constexpr double kSigmas = 3;
  return std::abs(across.dot(apart)) < same_m + kSigmas * std::sqrt(across.dot(both * across)) &&
         std::abs(sight.dot(apart)) < same_m + kSigmas * std::sqrt(sight.dot(both * sight));
}

}  // namespace

void FarEdges::Learn(const LandmarkFix& fix, const CameraView& left, std::span<const StereoMatch> matches) {
  const double variance = fix.covariance(2, 2);
  if (fix.verdict != Verdict::kFound || !(variance < kMostSigma_rad * kMostSigma_rad)) return;
  heading_variance_ = edges_.empty() ? variance : std::min(heading_variance_, variance);
  const Pose2 landmark_from_base = fix.base_from_landmark.Inverse();
  const Eigen::Matrix2d turn = landmark_from_base.rotation();
  const double side = landmark_from_base.x < 0 ? 1 : -1;
  for (const bool up : {true, false}) {
    for (const UprightEdge& seen : FindUprights(Running(left, matches, up), OptionsOf(options_))) {
      const FarEdge edge{landmark_from_base * seen.at, turn * seen.covariance * turn.transpose(),
                         seen.bottom_m, seen.top_m, up};
      const bool vague = std::sqrt(seen.covariance.trace()) > options_.most_share * seen.at.norm();
      if (side * edge.at.x() > options_.beyond_m && !vague) Add(edge, landmark_from_base.translation());
    }
  }
}

/// Both share the errors of the calibration, so together they are no surer than the surer one.
void FarEdges::Add(const FarEdge& edge, const Eigen::Vector2d& viewer) {
  const auto same = std::ranges::find_if(
      edges_, [&](const FarEdge& known) { return AreOne(known, edge, viewer, options_.same_m); });
  if (same == edges_.end()) {
    if (edges_.size() < options_.most) edges_.push_back(edge);
    return;
  }
  const Eigen::Matrix2d gain = same->covariance * (same->covariance + edge.covariance).inverse();
  same->at += gain * (edge.at - same->at);
  if (edge.covariance.trace() < same->covariance.trace()) same->covariance = edge.covariance;
  same->bottom_m = std::min(same->bottom_m, edge.bottom_m);
  same->top_m = std::max(same->top_m, edge.top_m);
}

}  // namespace priamos::head
