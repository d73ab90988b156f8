#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "head/core/bodies/body_agreement.hpp"
#include "head/core/bodies/contour_evidence.hpp"
#include "head/core/bodies/free_model_options.hpp"
#include "head/core/bodies/polyhedron.hpp"
#include "head/core/landmark/landmark_fix.hpp"

namespace priamos::head {

/// Where a free model is: all six degrees of freedom.
struct FreeModelFix {
  Verdict verdict = Verdict::kNoImage;
  Eigen::Isometry3d base_from_model = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< PoseSolution::covariance
  int n_matched = 0;
  double residual_px = 0;
  double misfit = 0;    ///< variance of the edges over the one that was expected
  double log_odds = 0;  ///< Association::log_odds, less what the model had to be bent
  BodyAgreement agreement{};
  std::optional<ContourEvidence> contour{};  ///< where linked edges do not agree enough, or are blurred
  double contour_odds = 0;                   ///< ContourEvidence::LogOdds of a blurred body
  double rival_log_odds = 0;                 ///< of the best different pose
  LandmarkModel seen;                        ///< what is visible of it at that pose
  std::vector<EdgeMatch> matches;            ///< edges of `seen`
};

/// Finds a body of flat faces in one or more images of the same moment, near `believed`: many poses of the
/// prior are compared with the images, the best ones are fitted to all edges, and the best of these must
/// explain the images far better than chance and than every different pose. What is hidden there is not
/// looked for; what should be seen and is not counts against a pose. Where the image itself is at hand, edges
/// that the operator lost are measured along the best poses, and if it is blurred the pose is fitted to the
/// steps of brightness along the contour, whose evidence decides. How well the edges fit tells how good
/// model and edges are, so the covariance is honest also when the model is better than the solver's options
/// say. Answers kFound, or why not: no usable image, nothing of it visible, too few edges found, two poses
/// alike, the model does not fit, elsewhere.
FreeModelFix LocateFreeModel(const Polyhedron& body, const Eigen::Isometry3d& believed,
                             std::span<const CameraView> views, const FreeModelOptions& options);

}  // namespace priamos::head
