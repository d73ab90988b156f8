#include "head/core/bodies/free_model_fix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/square.hpp"
#include "head/core/landmark/edge_observations.hpp"

namespace priamos::head {
namespace {

/// Gates from a proposal to the result [px], and how many of the best poses go through each.
struct Pass {
  double gate_px;
  int n_poses;
  bool coarse;
};
constexpr Pass kPasses[] = {{6, 100, true}, {3, 100, true}, {1.8, 3, false}, {1.2, 3, false}};

constexpr double kNever = 2;            ///< a share of the body that is never found
constexpr int kFewest = 5;              ///< edges with which a pose can be fitted and tested
constexpr double kSoft_px = 1.5;        ///< from that blur on, the operator loses more edges
constexpr double kSoftDetection = 0.7;  ///< chance that it finds one then

/// Everything that is known at one pose.
struct State {
  Eigen::Isometry3d base_from_model;
  LandmarkModel seen{};
  Association association{};
  PoseSolution solution{};
  double variance_scale = 1;  ///< variance of the edges over the one that is expected of them

  /// Chi squared by the variance that was expected.
  double Bent() const { return solution.chi_squared * variance_scale; }
  /// What it says for the pose that the edges fit more precisely than expected.
  double Precision() const { return 0.5 * solution.n_redundant * std::max(0.0, -std::log(variance_scale)); }
  /// With what the model had to be bent for it, by a variance of the edges that is `unit` times as large as
  /// expected.
  double LogOdds(double unit) const { return association.log_odds - Bent() / (2 * unit) + Precision(); }
};

class FreeSearch {
 public:
  FreeSearch(const Polyhedron& body, std::span<const CameraView> views, const FreeModelOptions& options,
             double distance_m)
      : body_(body), views_(views), options_(options) {
    for (const CameraView& view : views) {
      cameras_.push_back(view.camera);
      blur_px_ = std::max(blur_px_, view.blur_px);
      const double focal_px = view.camera->image_from_base.block<1, 3>(1, 0).norm();
      model_sigma_px_ = std::max(model_sigma_px_, options.solver.model_sigma_m * focal_px / distance_m);
    }
  }

  LandmarkModel VisibleAt(const Eigen::Isometry3d& base_from_model) const {
    return VisibleSkeleton(body_, base_from_model.inverse() * OpticalCentre(*cameras_[0]));
  }

  bool IsSharp() const { return blur_px_ <= kSoft_px; }

  /// One pass: the visible edges are compared with the images, then the pose is fitted.
  bool Refine(const Pass& pass, State& state) const {
    if (state.seen.edges.empty() || !pass.coarse) state.seen = VisibleAt(state.base_from_model);
    Look(pass.gate_px, state);
    if (static_cast<int>(state.association.matches.size()) < kFewest) return false;
    return pass.coarse ? Solve(1, true, state) : Adjust(state);
  }

 private:
  void Look(double gate_px, State& state) const {
    std::vector<int> all(state.seen.edges.size());
    std::iota(all.begin(), all.end(), 0);
    AssociationOptions association;
    association.gate_px = std::max(gate_px, 2.5 * std::hypot(model_sigma_px_, 0.3)) + 0.3 * blur_px_;
    gate_px_ = association.gate_px;
    association.sigma_px = association.gate_px / 2.5;
    association.max_angle_rad = 0.02 + 0.01 * association.gate_px;
    association.min_separation_px += 0.8 * blur_px_;
    association.corner_px += 2 * blur_px_;
    if (blur_px_ > kSoft_px) association.detection = kSoftDetection;
    state.association = Associate(state.seen, all, views_, state.base_from_model, association);
  }

  bool Solve(double variance_scale, bool coarse, State& state) const {
    const auto observations =
        Observations(state.seen, state.association, views_, state.base_from_model, coarse);
    PoseSolverOptions solver = options_.solver;
    const double factor = std::sqrt(variance_scale);
    solver.edge_sigma_px = factor * EdgeSigma();
    solver.model_sigma_m *= factor;
    solver.tilt_sigma_m *= factor;
    solver.find_suspect = !coarse;
    state.solution = SolvePose(state.seen, cameras_, observations, state.base_from_model, solver);
    state.variance_scale = variance_scale;
    if (state.solution.ok) state.base_from_model = state.solution.base_from_landmark;
    return state.solution.ok;
  }

  /// Least squares without the edges that contradict the others, and with the variance that these show (a
  /// posteriori variance of unit weight).
  bool Adjust(State& state) const { return DropOutliers(state) && FindVariance(state); }

  /// The worst edge is taken out again and again; the most likely of all these states is kept.
  bool DropOutliers(State& state) const {
    State tried = state;
    double most_likely = -1e99;
    const auto n_matches = [&] { return static_cast<int>(tried.association.matches.size()); };
    const int max_dropped = static_cast<int>(options_.max_outlier_share * n_matches());
    const int n_first = n_matches();
    for (int k = 0; k <= max_dropped && n_matches() >= kFewest; ++k) {
      if (!Solve(1, false, tried)) break;
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
  double LogLikelihood(const PoseSolution& solution, int n_outliers) const {
    constexpr double kOutlierOdds = 0.1;
    const double expected_px2 = Square(model_sigma_px_) + Square(EdgeSigma());
    const double variance_px2 = expected_px2 * std::max(kLeastScale, ScaleOf(solution));
    return -0.5 * solution.n_redundant * (1 + std::log(2 * kPi * variance_px2)) +
           n_outliers * (std::log(kOutlierOdds) - 2 * std::log(2 * gate_px_));
  }

  bool FindVariance(State& state) const {
    double scale = 1;
    for (int i = 0; i < 8; ++i) {
      const double found = ScaleOf(state.solution);
      if (std::abs(std::log(found)) < 0.1 || scale * found < kLeastScale) return true;
      scale *= found;
      if (!Solve(scale, false, state)) return false;
    }
    return true;
  }

  static constexpr double kLeastScale = 1e-3;

  double EdgeSigma() const { return options_.solver.edge_sigma_px + 0.08 * blur_px_; }

  /// Variance of the residuals over the supposed one; unbiased for the inverse, which errors are counted by.
  static double ScaleOf(const PoseSolution& solution) {
    return solution.n_redundant < 4 ? 1 : solution.chi_squared / (solution.n_redundant - 2);
  }

  const Polyhedron& body_;
  std::span<const CameraView> views_;
  const FreeModelOptions& options_;
  std::vector<const CameraModel*> cameras_;
  double blur_px_ = 0, model_sigma_px_ = 0;
  mutable double gate_px_ = 0;
};

/// Share of the visible length that was found; an edge that runs on where the model's ends is not the
/// model's.
double FoundShare(const Association& association) {
  const auto sum = [](const auto& px) { return std::accumulate(px.begin(), px.end(), 0.0); };
  const double predicted_px = sum(association.side_predicted_px);
  return predicted_px > 0 ? sum(association.side_found_px) / predicted_px : 0;
}

double TurnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return std::abs(Eigen::AngleAxisd((a.linear().transpose() * b.linear()).eval()).angle());
}

/// Judges poses by how far the middle of the body is from the first camera.
class Judge {
 public:
  Judge(const Eigen::Isometry3d& believed, const Eigen::Vector3d& middle, double distance_m, bool is_sharp,
        const FreeModelOptions& options)
      : believed_(believed),
        middle_(middle),
        distance_m_(distance_m),
        is_sharp_(is_sharp),
        options_(options) {}

  double ShiftShare(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    return (a * middle_ - b * middle_).norm() / distance_m_;
  }
  bool AreDistinct(const State& a, const State& b) const {
    return ShiftShare(a.base_from_model, b.base_from_model) > options_.distinct_share ||
           TurnBetween(a.base_from_model, b.base_from_model) > options_.distinct_rad;
  }

  Verdict Of(const State& state, const FreeModelFix& fix) const {
    if (static_cast<int>(state.association.matches.size()) < options_.min_matched ||
        fix.log_odds < options_.min_log_odds || fix.share < MinShare(state))
      return Verdict::kTooFewEdges;
    if (fix.misfit > options_.max_misfit) return Verdict::kResidualTooLarge;
    if (fix.log_odds - fix.rival_log_odds < options_.min_lead) return Verdict::kAmbiguous;
    const double shift = ShiftShare(believed_, state.base_from_model) / options_.prior_share;
    const double turn = TurnBetween(believed_, state.base_from_model) / options_.prior_rad;
    return std::hypot(shift, turn) > options_.max_prior_sigmas ? Verdict::kElsewhere : Verdict::kFound;
  }

 private:
  /// The share of the visible length that must be found, by how well the edges tell the pose; above 1 where
  /// they tell too little.
  double MinShare(const State& state) const {
    const double place = PlaceSigma(state) / distance_m_, turn = TurnSigma(state);
    if (place > options_.max_sigma_share || turn > options_.max_sigma_rad) return kNever;
    if (place <= options_.fine_sigma_share && turn <= options_.fine_sigma_rad) return options_.min_share;
    const bool is_clear = is_sharp_ && state.variance_scale <= options_.max_misfit_when_coarse;
    return is_clear ? options_.min_share_when_coarse : kNever;
  }

  /// Largest standard deviation in any direction.
  static double Largest(const Eigen::Matrix3d& covariance) {
    return std::sqrt(
        std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().maxCoeff()));
  }
  static double TurnSigma(const State& state) {
    return Largest(state.solution.covariance.bottomRightCorner<3, 3>());
  }
  /// Of the middle of the body, since the attitude moves the origin.
  double PlaceSigma(const State& state) const {
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
  const bool is_sharp_;
  const FreeModelOptions& options_;
};

/// The variance of the edges over the expected one, where it is larger, of the pose that fits best.
double UnitOf(const std::vector<State>& states) {
  double unit = 1e9;
  for (const State& state : states) unit = std::min(unit, state.variance_scale);
  return std::max(1.0, unit);
}

void SortByOdds(std::vector<State>& states) {
  const double unit = UnitOf(states);
  std::stable_sort(states.begin(), states.end(),
                   [&](const State& a, const State& b) { return a.LogOdds(unit) > b.LogOdds(unit); });
}

/// The poses after all passes, best first; those that lost too many edges are dropped.
std::vector<State> RefineAll(const FreeSearch& search, const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<State> states;
  states.reserve(poses.size());
  for (const Eigen::Isometry3d& pose : poses) states.push_back({pose});
  for (const Pass& pass : kPasses) {
    if (static_cast<int>(states.size()) > pass.n_poses) states.resize(pass.n_poses);
    std::erase_if(states, [&](State& state) { return !search.Refine(pass, state); });
    SortByOdds(states);
  }
  return states;
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
  const FreeSearch search(body, views, options, distance_m);
  fix.verdict = Verdict::kNotVisible;
  int n_visible = 0;
  for (const LandmarkEdge& edge : seen.edges)
    for (const CameraView& view : views)
      n_visible += ProjectEdge(*view.camera, view.size, believed * edge.from, believed * edge.to).has_value();
  if (n_visible < options.min_matched) return fix;
  const BodyPrior prior{options.prior_share * distance_m, options.prior_rad};
  const auto states = RefineAll(search, ProposeBodyPoses(seen, believed, views, prior, options.proposals));
  fix.verdict = Verdict::kTooFewEdges;
  if (states.empty()) return fix;
  const Judge judge(believed, middle, distance_m, search.IsSharp(), options);
  const State& best = states.front();
  const double unit = UnitOf(states);
  fix.base_from_model = best.base_from_model;
  fix.covariance = best.solution.covariance;
  fix.n_matched = static_cast<int>(best.association.matches.size());
  fix.residual_px = best.solution.rms_px;
  fix.misfit = best.variance_scale;
  fix.log_odds = best.LogOdds(unit);
  fix.share = FoundShare(best.association);
  for (const State& other : states)
    if (judge.AreDistinct(best, other))
      fix.rival_log_odds = std::max(fix.rival_log_odds, other.LogOdds(unit));
  fix.verdict = judge.Of(best, fix);
  fix.seen = best.seen;
  fix.matches = best.association.matches;
  return fix;
}

}  // namespace priamos::head
