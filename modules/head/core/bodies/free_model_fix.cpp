#include "head/core/bodies/free_model_fix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/square.hpp"
#include "head/core/bodies/contour_fit.hpp"
#include "head/core/bodies/free_search.hpp"
#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

double TurnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return std::abs(Eigen::AngleAxisd((a.linear().transpose() * b.linear()).eval()).angle());
}

/// A body where the grey values show its contour.
struct ContourFind {
  ContourPose pose;
  ContourEvidence evidence;
  double lead = 0;  ///< ContourEvidence::Shown over that of the best different pose
  BodyState linked{};
  BodyAgreement agreement{};  ///< of the edges there that were linked or measured along them
};

/// Judges poses by how far the middle of the body is from the first camera.
class Judge {
 public:
  Judge(const Eigen::Isometry3d& believed, const Eigen::Vector3d& middle, double distance_m,
        const FreeModelOptions& options)
      : believed_(believed), middle_(middle), distance_m_(distance_m), options_(options) {}

  double ShiftShare(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    return (a * middle_ - b * middle_).norm() / distance_m_;
  }
  bool AreDistinct(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    return ShiftShare(a, b) > options_.distinct_share || TurnBetween(a, b) > options_.distinct_rad;
  }

  Verdict Of(const BodyState& state, const FreeModelFix& fix) const {
    if (fix.log_odds < options_.min_log_odds || !(Agrees(state, fix) || IsShown(state, fix)) ||
        !IsWithin(options_.max_sigma_share, options_.max_sigma_rad, state))
      return Verdict::kTooFewEdges;
    if (fix.misfit > options_.max_misfit) return Verdict::kResidualTooLarge;
    if (fix.log_odds - fix.rival_log_odds < options_.min_lead) return Verdict::kAmbiguous;
    return IsElsewhere(state.base_from_model) ? Verdict::kElsewhere : Verdict::kFound;
  }

  Verdict Of(const ContourFind& find) const {
    if (Odds(find) < options_.min_contour_odds || !IsWithin(options_.max_sigma_share, options_.max_sigma_rad,
                                                            find.pose.base_from_model, find.pose.covariance))
      return Verdict::kTooFewEdges;
    if (find.lead < options_.min_contour_lead) return Verdict::kAmbiguous;
    return IsElsewhere(find.pose.base_from_model) ? Verdict::kElsewhere : Verdict::kFound;
  }

  /// Whether enough edges that were linked agree.
  bool Agrees(const BodyState& state, const FreeModelFix& fix) const {
    const bool fine = IsWithin(options_.fine_sigma_share, options_.fine_sigma_rad, state);
    return Linked(state) >= options_.min_matched &&
           fix.agreement.Value(fix.misfit) >=
               (fine ? options_.min_agreement : options_.min_agreement_when_coarse) + MoreFor(state);
  }

  double Odds(const ContourFind& find) const {
    return find.evidence.LogOdds(find.agreement, PriorSigmas(find.pose.base_from_model));
  }

 private:
  static int Linked(const BodyState& state) { return static_cast<int>(state.association.matches.size()); }

  /// Whether the grey values show enough of the contour, as in blurred images, whose edges link in pieces or
  /// not at all.
  bool IsShown(const BodyState& state, const FreeModelFix& fix) const {
    return fix.contour && std::max(Linked(state), fix.contour->n_seen) >= options_.min_matched &&
           fix.contour->Value(fix.agreement.Value(fix.misfit)) >= options_.min_evidence + MoreFor(state);
  }

  /// What is asked more of a pose far from the belief.
  double MoreFor(const BodyState& state) const {
    const double farther = Square(PriorSigmas(state.base_from_model)) - options_.usual_distance_squared;
    return options_.evidence_by_distance * std::max(0.0, farther);
  }

  /// Whether the edges tell the pose so well.
  bool IsWithin(double sigma_share, double sigma_rad, const BodyState& state) const {
    return IsWithin(sigma_share, sigma_rad, state.base_from_model, state.solution.covariance);
  }
  bool IsWithin(double sigma_share, double sigma_rad, const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance) const {
    return PlaceSigma(pose, covariance) <= sigma_share * distance_m_ &&
           Largest(covariance.bottomRightCorner<3, 3>()) <= sigma_rad;
  }

  /// How far a pose is from the belief.
  double PriorSigmas(const Eigen::Isometry3d& pose) const {
    return std::hypot(ShiftShare(believed_, pose) / options_.prior_share,
                      TurnBetween(believed_, pose) / options_.prior_rad);
  }
  bool IsElsewhere(const Eigen::Isometry3d& pose) const {
    return PriorSigmas(pose) > options_.max_prior_sigmas;
  }

  /// Largest standard deviation in any direction.
  static double Largest(const Eigen::Matrix3d& covariance) {
    return std::sqrt(
        std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().maxCoeff()));
  }
  /// Of the middle of the body, since the attitude moves the origin.
  double PlaceSigma(const Eigen::Isometry3d& pose, const Eigen::Matrix<double, 6, 6>& covariance) const {
    Eigen::Matrix<double, 3, 6> by_pose;
    const Eigen::Vector3d arm = pose.linear() * middle_;
    by_pose << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
    by_pose.col(3) = Eigen::Vector3d::UnitX().cross(arm);
    by_pose.col(4) = Eigen::Vector3d::UnitY().cross(arm);
    by_pose.col(5) = Eigen::Vector3d::UnitZ().cross(arm);
    return Largest(by_pose * covariance * by_pose.transpose());
  }

  const Eigen::Isometry3d& believed_;
  const Eigen::Vector3d middle_;
  const double distance_m_;
  const FreeModelOptions& options_;
};

/// The pose that shows most of the contour, of those that were fitted from `starts`.
std::optional<ContourFind> FindContour(const Polyhedron& body, std::span<const BodyState> starts,
                                       std::span<const CameraView> views, const Judge& judge,
                                       FreeSearch& search) {
  std::vector<ContourFind> finds;
  finds.reserve(starts.size());
  for (const BodyState& start : starts) {
    const auto pose = FitContour(body, start.base_from_model, views, search.meters());
    if (pose) finds.push_back({*pose, EvidenceOf(pose->seen, pose->base_from_model, views, search.meters())});
  }
  const auto best = std::max_element(finds.begin(), finds.end(), [](const auto& a, const auto& b) {
    return a.evidence.Shown() < b.evidence.Shown();
  });
  if (best == finds.end()) return std::nullopt;
  best->lead = best->evidence.Shown();
  for (const ContourFind& other : finds)
    if (judge.AreDistinct(best->pose.base_from_model, other.pose.base_from_model))
      best->lead = std::min(best->lead, best->evidence.Shown() - other.evidence.Shown());
  best->linked = search.LookAt(best->pose.base_from_model);
  best->agreement = AgreementOf(best->linked.association, search.blur_px());
  return *best;
}

FreeModelFix FixOf(const ContourFind& find, const Judge& judge) {
  FreeModelFix fix;
  fix.verdict = judge.Of(find);
  fix.base_from_model = find.pose.base_from_model;
  fix.covariance = find.pose.covariance;
  fix.n_matched = static_cast<int>(find.linked.association.matches.size());
  fix.residual_px = find.evidence.rms_px;
  fix.misfit = 1;
  fix.log_odds = find.linked.association.log_odds;
  fix.agreement = find.agreement;
  fix.contour = find.evidence;
  fix.contour_odds = judge.Odds(find);
  fix.seen = find.pose.seen;
  fix.matches = find.linked.association.matches;
  return fix;
}

/// Of linked edges, and of the grey values along the contour where these do not agree enough.
FreeModelFix FixOf(std::span<const BodyState> states, std::span<const CameraView> views,
                   const FreeSearch& search, const Judge& judge) {
  FreeModelFix fix;
  fix.verdict = Verdict::kTooFewEdges;
  if (states.empty()) return fix;
  const BodyState& best = states.front();
  const double unit = UnitOf(states);
  fix.base_from_model = best.base_from_model;
  fix.covariance = best.solution.covariance;
  fix.n_matched = static_cast<int>(best.association.matches.size());
  fix.residual_px = best.solution.rms_px;
  fix.misfit = best.variance_scale;
  fix.log_odds = best.LogOdds(unit);
  fix.agreement = AgreementOf(best.association, search.blur_px());
  if (!search.meters().empty() && !judge.Agrees(best, fix))
    fix.contour = EvidenceOf(best.seen, best.base_from_model, views, search.meters());
  for (const BodyState& other : states)
    if (judge.AreDistinct(best.base_from_model, other.base_from_model))
      fix.rival_log_odds = std::max(fix.rival_log_odds, other.LogOdds(unit));
  fix.verdict = judge.Of(best, fix);
  fix.seen = best.seen;
  fix.matches = best.association.matches;
  return fix;
}

/// Edges of the model that the images should show, all images together.
int VisibleEdges(const LandmarkModel& seen, const Eigen::Isometry3d& believed,
                 std::span<const CameraView> views) {
  int n = 0;
  for (const LandmarkEdge& edge : seen.edges)
    for (const CameraView& view : views)
      n += ProjectEdge(*view.camera, view.size, believed * edge.from, believed * edge.to).has_value();
  return n;
}

}  // namespace

FreeModelFix LocateFreeModel(const Polyhedron& body, const Eigen::Isometry3d& believed,
                             std::span<const CameraView> views, const FreeModelOptions& options) {
  FreeModelFix fix;
  if (views.empty() ||
      std::any_of(views.begin(), views.end(), [](const CameraView& view) { return IsBlind(*view.edges); }))
    return fix;
  const Eigen::Vector3d eye = OpticalCentre(*views[0].camera);
  const LandmarkModel seen = VisibleSkeleton(body, believed.inverse() * eye);
  const Eigen::Vector3d middle = MiddleOf(seen);
  const double distance_m = (believed * middle - eye).norm();
  FreeSearch search(body, views, options, middle, distance_m);
  fix.verdict = Verdict::kNotVisible;
  if (VisibleEdges(seen, believed, views) < options.min_matched) return fix;
  const BodyPrior prior{options.prior_share * distance_m, options.prior_rad};
  auto states = search.Roughly(ProposeBodyPoses(seen, believed, views, prior, options.proposals));
  const Judge judge(believed, middle, distance_m, options);
  if (search.meters().empty() || search.blur_px() < options.blurred_px)
    return FixOf(search.Refine(std::move(states)), views, search, judge);
  const auto find = FindContour(body, states, views, judge, search);
  fix.verdict = Verdict::kTooFewEdges;
  if (find) fix = FixOf(*find, judge);
  if (fix.verdict == Verdict::kFound || !options.trust_linked) return fix;
  const FreeModelFix linked = FixOf(search.Refine(std::move(states)), views, search, judge);
  return linked.verdict == Verdict::kFound || !find ? linked : fix;
}

}  // namespace priamos::head
