#include "head/core/bodies/free_model_fix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "head/core/bodies/free_search.hpp"
#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

double TurnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return std::abs(Eigen::AngleAxisd((a.linear().transpose() * b.linear()).eval()).angle());
}

/// Judges poses by how far the middle of the body is from the first camera.
class Judge {
 public:
  Judge(const Eigen::Isometry3d& believed, const Eigen::Vector3d& middle, double distance_m,
        const FreeModelOptions& options)
      : believed_(believed), middle_(middle), distance_m_(distance_m), options_(options) {}

  double ShiftShare(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    return (a * middle_ - b * middle_).norm() / distance_m_;
  }
  bool AreDistinct(const BodyState& a, const BodyState& b) const {
    return ShiftShare(a.base_from_model, b.base_from_model) > options_.distinct_share ||
           TurnBetween(a.base_from_model, b.base_from_model) > options_.distinct_rad;
  }

  Verdict Of(const BodyState& state, const FreeModelFix& fix) const {
    if (fix.log_odds < options_.min_log_odds || !(Agrees(state, fix) || IsShown(state, fix)) ||
        !IsWithin(options_.max_sigma_share, options_.max_sigma_rad, state))
      return Verdict::kTooFewEdges;
    if (fix.misfit > options_.max_misfit) return Verdict::kResidualTooLarge;
    if (fix.log_odds - fix.rival_log_odds < options_.min_lead) return Verdict::kAmbiguous;
    const double shift = ShiftShare(believed_, state.base_from_model) / options_.prior_share;
    const double turn = TurnBetween(believed_, state.base_from_model) / options_.prior_rad;
    return std::hypot(shift, turn) > options_.max_prior_sigmas ? Verdict::kElsewhere : Verdict::kFound;
  }

  /// Whether enough edges that were linked agree.
  bool Agrees(const BodyState& state, const FreeModelFix& fix) const {
    const bool fine = IsWithin(options_.fine_sigma_share, options_.fine_sigma_rad, state);
    return Linked(state) >= options_.min_matched &&
           fix.agreement.Value(fix.misfit) >=
               (fine ? options_.min_agreement : options_.min_agreement_when_coarse);
  }

 private:
  static int Linked(const BodyState& state) { return static_cast<int>(state.association.matches.size()); }

  /// Whether the grey values show enough of the contour, as in blurred images, whose edges link in pieces or
  /// not at all.
  bool IsShown(const BodyState& state, const FreeModelFix& fix) const {
    return fix.contour && std::max(Linked(state), fix.contour->n_seen) >= options_.min_matched &&
           fix.contour->Value(fix.agreement.Value(fix.misfit)) >= options_.min_evidence;
  }

  /// Whether the edges tell the pose so well.
  bool IsWithin(double sigma_share, double sigma_rad, const BodyState& state) const {
    return PlaceSigma(state) <= sigma_share * distance_m_ && TurnSigma(state) <= sigma_rad;
  }

  /// Largest standard deviation in any direction.
  static double Largest(const Eigen::Matrix3d& covariance) {
    return std::sqrt(
        std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().maxCoeff()));
  }
  static double TurnSigma(const BodyState& state) {
    return Largest(state.solution.covariance.bottomRightCorner<3, 3>());
  }
  /// Of the middle of the body, since the attitude moves the origin.
  double PlaceSigma(const BodyState& state) const {
    Eigen::Matrix<double, 3, 6> by_pose;
    const Eigen::Vector3d arm = state.base_from_model.linear() * middle_;
    by_pose << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
    by_pose.col(3) = Eigen::Vector3d::UnitX().cross(arm);
    by_pose.col(4) = Eigen::Vector3d::UnitY().cross(arm);
    by_pose.col(5) = Eigen::Vector3d::UnitZ().cross(arm);
    return Largest(by_pose * state.solution.covariance * by_pose.transpose());
  }

  const Eigen::Isometry3d& believed_;
  const Eigen::Vector3d middle_;
  const double distance_m_;
  const FreeModelOptions& options_;
};

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
  int n_visible = 0;
  for (const LandmarkEdge& edge : seen.edges)
    for (const CameraView& view : views)
      n_visible += ProjectEdge(*view.camera, view.size, believed * edge.from, believed * edge.to).has_value();
  if (n_visible < options.min_matched) return fix;
  const BodyPrior prior{options.prior_share * distance_m, options.prior_rad};
  const auto states = search.Refine(ProposeBodyPoses(seen, believed, views, prior, options.proposals));
  fix.verdict = Verdict::kTooFewEdges;
  if (states.empty()) return fix;
  const Judge judge(believed, middle, distance_m, options);
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
    if (judge.AreDistinct(best, other))
      fix.rival_log_odds = std::max(fix.rival_log_odds, other.LogOdds(unit));
  fix.verdict = judge.Of(best, fix);
  fix.seen = best.seen;
  fix.matches = best.association.matches;
  return fix;
}

}  // namespace priamos::head
