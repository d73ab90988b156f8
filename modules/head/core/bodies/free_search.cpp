#include "head/core/bodies/free_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/geometry.hpp"
#include "common/square.hpp"
#include "head/core/camera/projection.hpp"
#include "head/core/landmark/edge_observations.hpp"

namespace priamos::head {

/// Gates from a proposal to the result [px], and how many of the best poses go through each.
struct FreeSearch::Pass {
  double gate_px;
  int n_poses;
  bool coarse, guided;
};

namespace {

constexpr int kFewest = 5;              ///< edges with which a pose can be fitted and tested
constexpr double kSoft_px = 1.5;        ///< from that blur on, the operator loses more edges
constexpr double kSoftDetection = 0.7;  ///< chance that it finds one then
constexpr double kLeastScale = 1e-3;    ///< edges fit no better than by this share of the variance expected
constexpr double kLookGate_px = 1.8;
/// Poses this near to each other end as one: by a share of the distance, and by an angle.
constexpr double kSameShare = 0.001, kSame_rad = 0.001;

/// Variance of the residuals over the supposed one; unbiased for the inverse, which errors are counted by.
double ScaleOf(const PoseSolution& solution) {
  return solution.n_redundant < 4 ? 1 : solution.chi_squared / (solution.n_redundant - 2);
}

void SortByOdds(std::vector<BodyState>& states) {
  const double unit = UnitOf(states);
  std::stable_sort(states.begin(), states.end(),
                   [&](const BodyState& a, const BodyState& b) { return a.LogOdds(unit) > b.LogOdds(unit); });
}

}  // namespace

double BodyState::LogOdds(double unit) const {
  const double bent = solution.chi_squared * variance_scale;  // chi squared by the variance expected
  const double precision = 0.5 * solution.n_redundant * std::max(0.0, -std::log(variance_scale));
  return association.log_odds - bent / (2 * unit) + precision;
}

double UnitOf(std::span<const BodyState> states) {
  double unit = 1e9;
  for (const BodyState& state : states) unit = std::min(unit, state.variance_scale);
  return std::max(1.0, unit);
}

FreeSearch::FreeSearch(const Polyhedron& body, std::span<const CameraView> views,
                       const FreeModelOptions& options, const Eigen::Vector3d& middle, double distance_m)
    : body_(body), views_(views), options_(options), middle_(middle), distance_m_(distance_m) {
  for (const CameraView& view : views) {
    cameras_.push_back(view.camera);
    blur_px_ = std::max(blur_px_, view.blur_px);
    const double focal_px = view.camera->image_from_base.block<1, 3>(1, 0).norm();
    model_sigma_px_ = std::max(model_sigma_px_, options.solver.model_sigma_m * focal_px / distance_m);
  }
  if (std::any_of(views.begin(), views.end(), [](const CameraView& view) { return !view.image; })) return;
  guides_.reserve(views.size());
  meters_.reserve(views.size());
  for (const CameraView& view : views) {
    guides_.emplace_back(*view.image, view.edges->noise_sigma, view.blur_px);
    meters_.emplace_back(*view.image, view.edges->noise_sigma, view.blur_px);
  }
}

std::vector<BodyState> FreeSearch::Roughly(std::span<const Eigen::Isometry3d> poses) {
  std::vector<BodyState> states;
  states.reserve(poses.size());
  for (const Eigen::Isometry3d& pose : poses) states.push_back({pose});
  constexpr Pass kFirst{6, 100, true, false};
  Refine(kFirst, states);
  return states;
}

std::vector<BodyState> FreeSearch::Refine(std::vector<BodyState> states) {
  constexpr Pass kPasses[] = {{3, 100, true, true}, {1.8, 3, false, true}, {1.2, 3, false, true}};
  for (const Pass& pass : kPasses) Refine(pass, states);
  return states;
}

void FreeSearch::Refine(const Pass& pass, std::vector<BodyState>& states) {
  if (static_cast<int>(states.size()) > pass.n_poses) states.resize(pass.n_poses);
  std::erase_if(states, [&](BodyState& state) { return !Refine(pass, state); });
  SortByOdds(states);
  DropRepeated(states);
}

BodyState FreeSearch::LookAt(const Eigen::Isometry3d& pose) {
  BodyState state{pose};
  state.seen = VisibleSkeleton(body_, pose.inverse() * OpticalCentre(*cameras_[0]));
  Guide(state);
  Look(kLookGate_px, state);
  return state;
}

/// Poses that came to the same place are fitted once: the best of them is kept.
void FreeSearch::DropRepeated(std::vector<BodyState>& states) const {
  std::vector<BodyState> kept;
  kept.reserve(states.size());
  for (BodyState& state : states) {
    const auto is_same = [&](const BodyState& other) {
      return IsSame(state.base_from_model, other.base_from_model);
    };
    if (std::none_of(kept.begin(), kept.end(), is_same)) kept.push_back(std::move(state));
  }
  states = std::move(kept);
}

bool FreeSearch::IsSame(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
  const Eigen::AngleAxisd turn((a.linear().transpose() * b.linear()).eval());
  return (a * middle_ - b * middle_).norm() < kSameShare * distance_m_ && std::abs(turn.angle()) < kSame_rad;
}

/// One pass: the visible edges are compared with the images, then the pose is fitted. In the end by least
/// squares without the edges that contradict the others, and with the variance that these show (a posteriori
/// variance of unit weight).
bool FreeSearch::Refine(const Pass& pass, BodyState& state) {
  if (state.seen.edges.empty() || !pass.coarse)
    state.seen = VisibleSkeleton(body_, state.base_from_model.inverse() * OpticalCentre(*cameras_[0]));
  if (pass.guided) Guide(state);
  Look(pass.gate_px, state);
  if (static_cast<int>(state.association.matches.size()) < kFewest) return !pass.guided && !guides_.empty();
  return pass.coarse ? Solve(1, Fitted::kRoughly, state) : DropOutliers(state) && FindVariance(state);
}

void FreeSearch::Guide(BodyState& state) {
  if (!guides_.empty())
    state.guided = std::make_shared<GuidedViews>(state.seen, state.base_from_model, views_, guides_, meters_);
}

std::span<const CameraView> FreeSearch::ViewsOf(const BodyState& state) const {
  return state.guided ? state.guided->views() : views_;
}

void FreeSearch::Look(double gate_px, BodyState& state) {
  std::vector<int> all(state.seen.edges.size());
  std::iota(all.begin(), all.end(), 0);
  AssociationOptions association;
  association.gate_px = std::max(gate_px, 2.5 * std::hypot(model_sigma_px_, 0.3)) + 0.3 * blur_px_;
  gate_px_ = association.gate_px;
  association.sigma_px = association.gate_px / 2.5;
  association.max_angle_rad = 0.02 + 0.01 * association.gate_px;
  association.min_separation_px += 0.8 * blur_px_;
  association.corner_px += 2 * blur_px_;
  association.free_overshoot_px += 2 * blur_px_;
  if (blur_px_ > kSoft_px) association.detection = kSoftDetection;
  state.association = Associate(state.seen, all, ViewsOf(state), state.base_from_model, association);
}

bool FreeSearch::Solve(double variance_scale, Fitted fitted, BodyState& state) const {
  const auto observations = Observations(state.seen, state.association, ViewsOf(state), state.base_from_model,
                                         fitted == Fitted::kRoughly);
  PoseSolverOptions solver = options_.solver;
  const double factor = std::sqrt(variance_scale);
  solver.edge_sigma_px = factor * EdgeSigma();
  solver.model_sigma_m *= factor;
  solver.tilt_sigma_m *= factor;
  solver.find_suspect = fitted == Fitted::kWithSuspect;
  state.solution = SolvePose(state.seen, cameras_, observations, state.base_from_model, solver);
  state.variance_scale = variance_scale;
  if (state.solution.ok) state.base_from_model = state.solution.base_from_landmark;
  return state.solution.ok;
}

/// The worst edge is taken out again and again; the most likely of all these states is kept.
bool FreeSearch::DropOutliers(BodyState& state) const {
  BodyState tried = state;
  double most_likely = -1e99;
  const auto n_matches = [&] { return static_cast<int>(tried.association.matches.size()); };
  const int max_dropped = static_cast<int>(options_.max_outlier_share * n_matches());
  const int n_first = n_matches();
  for (int k = 0; k <= max_dropped && n_matches() >= kFewest; ++k) {
    if (!Solve(1, Fitted::kWithSuspect, tried)) break;
    if (const double l = LogLikelihood(tried.solution, n_first - n_matches()); l > most_likely) {
      most_likely = l;
      state = tried;
    }
    const EdgeSuspect& suspect = tried.solution.suspect;
    if (suspect.edge < 0) break;
    tried.association.Withdraw(tried.seen, suspect.edge, suspect.camera);
  }
  return most_likely > -1e99;
}

/// Of edges with the variance found, and of outliers anywhere within the gate.
double FreeSearch::LogLikelihood(const PoseSolution& solution, int n_outliers) const {
  constexpr double kOutlierOdds = 0.1;
  const double expected_px2 = Square(model_sigma_px_) + Square(EdgeSigma());
  const double variance_px2 = expected_px2 * std::max(kLeastScale, ScaleOf(solution));
  return -0.5 * solution.n_redundant * (1 + std::log(2 * kPi * variance_px2)) +
         n_outliers * (std::log(kOutlierOdds) - 2 * std::log(2 * gate_px_));
}

bool FreeSearch::FindVariance(BodyState& state) const {
  double scale = 1;
  for (int i = 0; i < 8; ++i) {
    const double found = ScaleOf(state.solution);
    if (std::abs(std::log(found)) < 0.1 || scale * found < kLeastScale) return true;
    scale *= found;
    if (!Solve(scale, Fitted::kFinely, state)) return false;
  }
  return true;
}

}  // namespace priamos::head
