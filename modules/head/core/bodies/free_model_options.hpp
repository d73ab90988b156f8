#pragma once

#include "head/core/bodies/body_proposals.hpp"
#include "head/core/landmark/pose_solver.hpp"

namespace priamos::head {

/// Where a free model is looked for, and what evidence a fix needs.
struct FreeModelOptions {
  /// How well the believed pose is known along and about each axis: as a share of the distance from the first
  /// camera, and as an angle.
  double prior_share = 0.035, prior_rad = 0.03;
  double max_prior_sigmas = 3.5;  ///< farther from the belief is "elsewhere"
  BodyProposalOptions proposals{};
  int min_matched = 6;      ///< edges that must be found or seen, all images together
  double min_log_odds = 6;  ///< of the body there against clutter only
  /// ContourEvidence::Value: enough by itself, as the agreement is, in images that are not blurred.
  double min_evidence = 3.42;
  /// From that blur on the contour alone decides, by ContourEvidence::LogOdds: the linked edges of another
  /// body may agree as well as those of the right one.
  double blurred_px = 2, min_contour_odds = 2.2;
  double min_contour_lead = 0.45;  ///< ContourEvidence::Shown over the best different pose
  /// Whether linked edges that agree are enough in blurred images, too, as for a body that is followed.
  bool trust_linked = false;
  double min_agreement = 1.15;  ///< BodyAgreement::Value
  /// The same where the edges tell the pose less well than fine_sigma_*, as of a small body: one of another
  /// size fits them nearly as well.
  double min_agreement_when_coarse = 1.25;
  /// Both limits, and min_evidence, grow by that for each unit by which the squared distance from the belief,
  /// in sigmas, is more than three of four beliefs have (chi squared of six degrees of freedom).
  double usual_distance_squared = 8, evidence_by_distance = 0.2;
  double min_lead = 4;                                  ///< log odds over the best different pose
  double distinct_share = 0.01, distinct_rad = 0.0175;  ///< poses farther apart are different
  double max_misfit = 4;  ///< largest variance of the edges over the one that is expected of them
  double max_outlier_share = 0.3;
  /// Standard deviation of the place over the distance, and of the attitude, in the worst direction: what a
  /// fix must at least tell.
  double max_sigma_share = 0.02, max_sigma_rad = 0.05;
  double fine_sigma_share = 0.004, fine_sigma_rad = 0.007;
  PoseSolverOptions solver{.on_floor = false, .edge_sigma_px = 0.03, .max_iterations = 15};
};

}  // namespace priamos::head
