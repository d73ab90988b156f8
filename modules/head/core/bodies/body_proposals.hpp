#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// How far a body may be from where it is believed to be: standard deviations along and about each axis.
struct BodyPrior {
  double sigma_m = 0, sigma_rad = 0;
};

/// How densely poses are tried.
struct BodyProposalOptions {
  int n_poses = 800;              ///< tried all over the prior
  double sigma_px = 6;            ///< an image edge so far beside its prediction still counts for 0.6
  double fine_sigma_px = 3;       ///< the same for those that are climbed from
  int n_climbed = 8, n_best = 6;  ///< poses that are improved, and those that are returned
};

/// Poses of a body that explain the images best, best first, all different: those of a low-discrepancy
/// sequence over the prior, the best of which climb to the nearest maximum. The measure is the share of the
/// visible edges `seen` (landmark frame) beside which image edges of their direction run. Deterministic.
std::vector<Eigen::Isometry3d> ProposeBodyPoses(const LandmarkModel& seen, const Eigen::Isometry3d& believed,
                                                std::span<const CameraView> views, const BodyPrior& prior,
                                                const BodyProposalOptions& options);

/// The middle of the model's edges, landmark frame.
Eigen::Vector3d MiddleOf(const LandmarkModel& model);

}  // namespace priamos::head
