#pragma once

#include <Eigen/Geometry>
#include <span>

#include "head/core/bodies/body_proposals.hpp"
#include "head/core/bodies/polyhedron.hpp"
#include "head/core/landmark/landmark_fix.hpp"

namespace priamos::head {

/// Where a free model is looked for, and what evidence a fix needs.
struct FreeModelOptions {
  /// How well the believed pose is known along and about each axis: as a share of the distance from the first
  /// camera, and as an angle.
  double prior_share = 0.035, prior_rad = 0.03;
  double max_prior_sigmas = 3.5;  ///< farther from the belief is "elsewhere"
  BodyProposalOptions proposals{};
  int min_matched = 6;      ///< edges that must be found, all images together
  double min_log_odds = 6;  ///< of the body there against clutter only
  double min_share = 0.55;  ///< of the visible length that must be found, all images together
  /// The same where the edges tell the pose less well than fine_sigma_*; the images must be sharp then, and
  /// the edges fit better.
  double min_share_when_coarse = 0.7, max_misfit_when_coarse = 2.5;
  double min_lead = 4;                                  ///< log odds over the best different pose
  double distinct_share = 0.01, distinct_rad = 0.0175;  ///< poses farther apart are different
  double max_misfit = 4;  ///< largest variance of the edges over the one that is expected of them
  double outlier_misfit =
      9;  ///< an edge that fits worse than that, by the variance found, is not the model's
  double max_outlier_share = 0.3;
  /// Standard deviation of the place over the distance, and of the attitude: what a fix must at least tell,
  /// and from where on more of the body must be found. A small body is known less well than a large one, and
  /// so is a pose by chance.
  double max_sigma_share = 0.02, max_sigma_rad = 0.05;
  double fine_sigma_share = 0.004, fine_sigma_rad = 0.007;
  PoseSolverOptions solver{.on_floor = false, .edge_sigma_px = 0.03, .max_iterations = 15};
};

/// Where a free model is: all six degrees of freedom.
struct FreeModelFix {
  Verdict verdict = Verdict::kNoImage;
  Eigen::Isometry3d base_from_model = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< PoseSolution::covariance
  int n_matched = 0;
  double residual_px = 0;
  double misfit = 0;               ///< variance of the edges over the one that was expected
  double log_odds = 0;             ///< Association::log_odds, less what the model had to be bent
  double share = 0;                ///< found share of the visible length, all images together
  double rival_log_odds = 0;       ///< of the best different pose
  LandmarkModel seen;              ///< what is visible of it at that pose
  std::vector<EdgeMatch> matches;  ///< edges of `seen`
};

/// Finds a body of flat faces in one or more images of the same moment, near `believed`: many poses of the
/// prior are compared with the images, the best ones are fitted to all edges, and the best of these must
/// explain the images far better than chance and than every different pose. What is hidden there is not
/// looked for; what should be seen and is not counts against a pose. How well the edges fit tells how good
/// model and edges are, so the covariance is honest also when the model is better than the solver's options
/// say. Answers kFound, or why not: no usable image, nothing of it visible, too few edges found, two poses
/// alike, the model does not fit, elsewhere.
FreeModelFix LocateFreeModel(const Polyhedron& body, const Eigen::Isometry3d& believed,
                             std::span<const CameraView> views, const FreeModelOptions& options);

}  // namespace priamos::head
