#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "head/core/camera/camera_model.hpp"
#include "head/core/edges/edge_segment.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/pose_proposals.hpp"
#include "head/core/landmark/pose_refinement.hpp"
#include "head/core/stereo/vertical_stereo.hpp"

namespace priamos::head {

/// Outcome of a look; the values are those of landmark_fix_t.
enum class Verdict {
  kFound = 0,
  kNoModel = 1,
  kNoPose = 2,
  kNoImage = 3,           ///< no image, or a black, saturated or too small one
  kNotVisible = 4,        ///< the prediction has too few edges in the images
  kTooFewEdges = 5,       ///< too few of them were found
  kAmbiguous = 6,         ///< two different poses explain the images about equally well
  kResidualTooLarge = 7,  ///< found, but the model does not fit well enough
  kElsewhere = 8          ///< found where the prediction and its covariance exclude it
};

/// The verdict in words, for logs and operators.
const char* Describe(Verdict verdict);

/// Where the robot believes the landmark to be: the prior of the search, not of the result.
struct LandmarkPrediction {
  Pose2 base_from_landmark;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of (x, y, yaw), base frame [m, rad]
};

/// The landmark as reconstructed from one stereo pair.
struct LandmarkFix {
  Verdict verdict = Verdict::kNoImage;
  Pose2 base_from_landmark;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of (x, y, yaw), base frame [m, rad]
  double own_share = 0;                                  ///< PoseSolution::own_share
  int n_matched = 0;                                     ///< model edges found, all images together
  double residual_px = 0;                                ///< RMS distance of the matched edges from the model
  double misfit = 0;                                     ///< PoseSolution::misfit
  double side_share = 1;      ///< found share of the visible length of the weaker side
  double log_odds = 0;        ///< Association::log_odds
  double best_log_odds = 0;   ///< Association::best_log_odds
  double rival_log_odds = 0;  ///< log_odds of the best different pose
  std::vector<EdgeMatch> matches;
  EdgeShifts edge_shifts;  ///< PoseSolution::edge_shifts
  Breadth breadth;         ///< PoseSolution::breadth
  ModelErrors errors;      ///< what this look and earlier ones showed of the model; empty without a fix
};

/// Where a landmark is looked for, and what evidence a fix needs.
struct LandmarkFixOptions : RefinementOptions {
  double min_sigma_m = 0.02, min_sigma_rad = 0.01;  ///< added to the prediction's covariance
  double gate = 4;  ///< Mahalanobis distance from the prediction, 3 degrees of freedom
  double gate_elsewhere =
      7;                  ///< Mahalanobis distance up to which it is searched; beyond `gate` it is refused
  int min_predicted = 4;  ///< edges that must be predicted, all images together
  int min_matched_sharp =
      4;  ///< and that many where the prediction is sharp: one jamb's, when the base is near
  double min_log_odds = 7;          ///< log odds wanted beyond the logarithm of the number of poses tried
  double min_share = 0.4;           ///< share of the log odds that a perfect match would give
  double min_share_tracked = 0.15;  ///< and where the landmark was followed up to here
  /// A landmark that would give no more log odds than few_log_odds is soon taken for something else: this
  /// share of them must be found. Of others less will do, with a lead over landmarks of their kind.
  double nearly_all = 0.85, few_log_odds = 40;
  double min_side_share = 0.1;  ///< least side_share of a fix
  double sharp_m =
      0.08;  ///< a prediction with a smaller sigma of the place leaves no room for another landmark
  double tracked_m = 0.035;  ///< the same, of one that was followed: its edges can be nothing else's
  double one_sided_log_odds =
      5;  ///< log odds wanted in addition if only one side is in view: it could be another landmark's
  double min_lead = 6;               ///< log odds wanted over the best different pose
  double min_lead_over_breadth = 2;  ///< and over the same landmark with one side clearly elsewhere
  double max_residual_px = 1.2;
  double distinct_m = 0.03, distinct_rad = 0.02;  ///< poses farther apart are different
  VerticalStereoOptions stereo;
  ProposalOptions proposals;

  /// The prediction's covariance of (x, y, yaw), widened by the minimum sigmas [m, rad].
  Eigen::Matrix3d SearchCovariance(const LandmarkPrediction& prediction) const;
  /// Whether a search with this covariance leaves no room for another landmark.
  bool IsSharp(const Eigen::Matrix3d& search) const;
  /// Whether it is that of a landmark that was followed: what of it is found is enough, the rest may be
  /// outside of the pictures, or too near for them.
  bool IsTracked(const Eigen::Matrix3d& search) const;
};

/// Finds the landmark in the images of two or three cameras: vertical edges of the first two are
/// reconstructed, pairs of them laid onto pairs of the model's edges wherever the prediction allows it, every
/// pose proposed is judged by all edges in all images, and the best one refined over all their points. It
/// answers FOUND only if the evidence for it is far beyond chance and far above that of every other pose; the
/// estimate then depends on the images alone, not on the prediction.
class LandmarkFinder {
 public:
  explicit LandmarkFinder(const LandmarkFixOptions& options) : options_(options) {}
  const LandmarkFixOptions& options() const { return options_; }

  /// The fix from the undistorted edges of all images, in the frame of their cameras (base): left, right, and
  /// the third camera's if there is one. Nothing to be seen in one of the first two gives kNoImage; such a
  /// third one is left out. `known` is what earlier looks showed of the same model: its edges are looked for
  /// there, and they tell more than by the model's own sigmas.
  LandmarkFix Find(const LandmarkModel& model, const LandmarkPrediction& prediction,
                   std::span<const CameraView> views, const ModelErrors* known = nullptr) const;
  /// From one stereo pair.
  LandmarkFix Find(const LandmarkModel& model, const LandmarkPrediction& prediction, const StereoViews& views,
                   const ModelErrors* known = nullptr) const {
    return Find(model, prediction, std::span<const CameraView>(views), known);
  }

 private:
  /// What is looked for, where and in which images.
  struct Sought {
    const LandmarkModel& model;
    const LandmarkPrediction& prediction;
    const Eigen::Matrix3d& search;  ///< covariance of the prediction, as far as is searched
    std::span<const CameraView> views;
    int n_tested;  ///< poses proposed
  };
  LandmarkFix FindKnown(const LandmarkModel& model, const LandmarkPrediction& prediction,
                        std::span<const CameraView> views, const ModelErrors& known) const;
  std::vector<RefinedPose> BestStarts(const LandmarkModel& model, std::span<const PoseProposal> proposals,
                                      std::span<const CameraView> views) const;
  bool IsNearlyAll(const Association& association) const;
  bool IsOtherBreadth(const LandmarkModel& model, std::span<const CameraView> views,
                      const RefinedPose& pose) const;
  double RivalLogOdds(const LandmarkPrediction& prediction, const Eigen::Matrix3d& search,
                      const std::vector<RefinedPose>& poses, const RefinedPose& best) const;
  LandmarkFix AnswerWith(const Sought& sought, const PoseRefinement& refinement,
                         const std::vector<RefinedPose>& poses, RefinedPose chosen) const;
  void Judge(const Sought& sought, const RefinedPose& best, LandmarkFix& fix) const;

  LandmarkFixOptions options_;
};

/// Why nothing can be seen in the image: too small, black or white all over, without contrast; empty if it is
/// of use.
std::string_view WhyBlind(const EdgeImage& edges);
inline bool IsBlind(const EdgeImage& edges) {
  return !WhyBlind(edges).empty();
}

}  // namespace priamos::head
