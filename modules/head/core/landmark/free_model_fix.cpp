#include "head/core/landmark/free_model_fix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "head/core/landmark/edge_observations.hpp"

namespace priamos::head {
namespace {

/// Everything that is known at one pose.
struct State {
  Eigen::Isometry3d base_from_model;
  LandmarkModel seen;
  Association association;
  PoseSolution solution;
};

class Search {
 public:
  Search(const Polyhedron& body, std::span<const CameraView> views, const FreeModelOptions& options)
      : body_(body), views_(views), options_(options) {
    for (const CameraView& view : views) cameras_.push_back(view.camera);
  }

  /// The visible edges at the pose, compared with the images.
  void Look(double gate_px, State& state) const {
    const Eigen::Vector3d eye = state.base_from_model.inverse() * OpticalCentre(*cameras_[0]);
    state.seen = VisibleSkeleton(body_, eye);
    std::vector<int> all(state.seen.edges.size());
    std::iota(all.begin(), all.end(), 0);
    AssociationOptions association;
    association.gate_px = gate_px;
    association.sigma_px = gate_px / 3;
    association.max_angle_rad = 0.02 + 0.01 * gate_px;
    state.association = Associate(state.seen, all, views_, state.base_from_model, association);
  }

  bool Solve(State& state) const {
    const auto observations =
        Observations(state.seen, state.association, views_, state.base_from_model, false);
    state.solution = SolvePose(state.seen, cameras_, observations, state.base_from_model, options_.solver);
    if (state.solution.ok) state.base_from_model = state.solution.base_from_landmark;
    return state.solution.ok;
  }

  /// Least squares without what contradicts all the rest.
  bool SolveRobustly(State& state) const {
    for (int dropped = 0;; ++dropped) {
      if (!Solve(state)) return false;
      const EdgeSuspect& suspect = state.solution.suspect;
      if (suspect.misfit < options_.outlier_misfit || dropped == options_.max_outliers) return true;
      state.association.Withdraw(state.seen, suspect.edge, suspect.camera);
    }
  }

 private:
  const Polyhedron& body_;
  std::span<const CameraView> views_;
  const FreeModelOptions& options_;
  std::vector<const CameraModel*> cameras_;
};

double FoundShare(const Association& association) {
  const double predicted =
      std::accumulate(association.side_predicted_px.begin(), association.side_predicted_px.end(), 0.0);
  const double found =
      std::accumulate(association.side_found_px.begin(), association.side_found_px.end(), 0.0);
  return predicted > 0 ? found / predicted : 0;
}

Verdict Judge(const State& state, const Eigen::Isometry3d& believed, const FreeModelOptions& options) {
  const Eigen::Isometry3d moved = believed.inverse() * state.base_from_model;
  const double turn = Eigen::AngleAxisd(moved.linear()).angle();
  if (static_cast<int>(state.association.matches.size()) < options.min_matched ||
      FoundShare(state.association) < options.min_share)
    return Verdict::kTooFewEdges;
  if (state.solution.misfit > options.max_misfit) return Verdict::kResidualTooLarge;
  if (moved.translation().norm() > options.max_shift_m || std::abs(turn) > options.max_turn_rad)
    return Verdict::kElsewhere;
  return Verdict::kFound;
}

/// One sequence of gates from the belief to the result.
FreeModelFix Approach(const Search& search, const Eigen::Isometry3d& believed, double widening,
                      const FreeModelOptions& options) {
  FreeModelFix fix;
  State state{believed, {}, {}, {}};
  for (const double gate_px : options.gates_px) {
    search.Look(std::max(options.gates_px.back(), widening * gate_px), state);
    fix.verdict = Verdict::kNotVisible;
    if (state.association.n_predicted < options.min_matched) return fix;
    fix.verdict = Verdict::kTooFewEdges;
    if (static_cast<int>(state.association.matches.size()) < options.min_matched) return fix;
    if (!search.SolveRobustly(state)) return fix;
  }
  fix.verdict = Judge(state, believed, options);
  fix.base_from_model = state.base_from_model;
  fix.covariance = state.solution.covariance;
  fix.n_matched = static_cast<int>(state.association.matches.size());
  fix.residual_px = state.solution.rms_px;
  fix.misfit = state.solution.misfit;
  fix.seen = std::move(state.seen);
  fix.matches = std::move(state.association.matches);
  return fix;
}

}  // namespace

FreeModelFix LocateFreeModel(const Polyhedron& body, const Eigen::Isometry3d& believed,
                             std::span<const CameraView> views, const FreeModelOptions& options) {
  if (views.empty() ||
      std::any_of(views.begin(), views.end(), [](const CameraView& view) { return IsBlind(*view.edges); }))
    return {};
  const Search search(body, views, options);
  FreeModelFix first = Approach(search, believed, 1, options);
  for (const double widening : options.retries) {
    if (first.verdict == Verdict::kFound || first.verdict == Verdict::kNotVisible) break;
    if (FreeModelFix again = Approach(search, believed, widening, options); again.verdict == Verdict::kFound)
      return again;
  }
  return first;
}

}  // namespace priamos::head
