#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// Which edges may be upright, and how exactly such are.
struct UprightOptions {
  double max_slope_rad = 0.6;     ///< of an edge against the picture's columns: cameras are held about level
  double min_length_px = 15;      ///< shorter ones point anywhere
  double capped_length_px = 150;  ///< an edge weighs as its length up to here
  double lean_sigma_rad = 0.003;  ///< of things that are built upright
  double camera_sigma_rad = 0.0008;  ///< error that all edges of a camera share
  double max_sigma_rad = 0.03;       ///< a direction known less well is none
  double max_log_chance = -3;        ///< natural logarithm: expected number of agreements as good by chance
  double rival_share = 0.5;          ///< of the votes: another direction with so many others is one as well
};

/// An edge as evidence of a direction of space: its plane of sight holds that.
struct UprightVote {
  Eigen::Vector3d normal;  ///< unit normal of the plane of sight
  /// Change of `normal` with the edge's place and with its direction, each by one standard deviation.
  std::array<Eigen::Vector3d, 2> noise;
  double weight = 0;  ///< capped length [px]

  /// Standard deviation of normal.dot(direction), without the lean of what was seen [rad].
  double Sigma(const Eigen::Vector3d& direction) const;
};

/// The steep edges of all views, the longest first. The views' common frame is the first camera's own (x
/// right, y down, z forward).
std::vector<UprightVote> SteepEdges(std::span<const CameraView> views, const UprightOptions& options);

/// All other edges that are long enough, in the same frame: some of them are level.
std::vector<UprightVote> OtherEdges(std::span<const CameraView> views, const UprightOptions& options);

}  // namespace priamos::head
