#include "head/core/landmark/pose_refinement.hpp"

#include <cmath>
#include <utility>

#include "head/core/landmark/edge_observations.hpp"

namespace priamos::head {
namespace {

/// Gates of the later passes.
constexpr AssociationOptions kApproached{.sigma_px = 1.0, .gate_px = 3.0, .max_angle_rad = 0.04};
constexpr AssociationOptions kRefined{.sigma_px = 0.5, .gate_px = 1.6, .max_angle_rad = 0.03};

Pose2 Flatten(const Eigen::Isometry3d& t) {
  return {t.translation().x(), t.translation().y(), std::atan2(t.linear()(1, 0), t.linear()(0, 0))};
}

}  // namespace

std::vector<int> VisibleAt(const LandmarkModel& model, const Pose2& base_from_landmark, double margin_rad) {
  const Eigen::Vector2d viewer = base_from_landmark.Inverse().translation();
  std::vector<int> visible;
  for (std::size_t i = 0; i < model.edges.size(); ++i) {
    if (model.edges[i].IsSeenFrom(viewer, margin_rad)) visible.push_back(static_cast<int>(i));
  }
  return visible;
}

bool PoseRefinement::Approach(RefinedPose& pose) const {
  return Pass(kProposed, true, pose);
}

void PoseRefinement::Refine(RefinedPose& pose) const {
  if (Pass(kApproached, true, pose) && Pass(kRefined, false, pose)) MatchAgain(pose);
}

void PoseRefinement::MatchAgain(RefinedPose& pose) const {
  Match(kRefined, pose);
  if (!Solve(options_.solver.edge_sigma_px, pose)) return;
  pose.sharp_chi_squared = pose.solution.chi_squared;
  const bool fits = pose.solution.suspect.misfit < options_.outlier_misfit;
  if (!fits && DropWrong(pose)) Adjust(pose);
}

ModelErrors PoseRefinement::Learn(const RefinedPose& pose) const {
  PoseSolverOptions solver = options_.solver;
  solver.edge_sigma_px = pose.edge_sigma_px;
  solver.find_suspect = false;
  solver.learn = true;
  PoseSolution solution = SolutionOf(pose, false, solver);
  return solution.ok ? std::move(solution.errors) : ModelErrors{};
}

void PoseRefinement::Match(const AssociationOptions& gate, RefinedPose& pose) const {
  const LandmarkModel seen = Shifted(model_, pose.solution.edge_shifts);
  pose.association = Associate(seen, VisibleAt(model_, pose.base_from_landmark), views_,
                               Lift(pose.base_from_landmark), gate);
}

bool PoseRefinement::Pass(const AssociationOptions& gate, bool coarse, RefinedPose& pose) const {
  Match(gate, pose);
  PoseSolverOptions solver = options_.solver;
  solver.find_suspect = false;
  pose.solution = SolutionOf(pose, coarse, solver);
  if (pose.solution.ok) pose.base_from_landmark = Flatten(pose.solution.base_from_landmark);
  return pose.solution.ok;
}

bool PoseRefinement::Solve(double edge_sigma_px, RefinedPose& pose) const {
  PoseSolverOptions solver = options_.solver;
  solver.edge_sigma_px = pose.edge_sigma_px = edge_sigma_px;
  pose.solution = SolutionOf(pose, false, solver);
  if (pose.solution.ok) pose.base_from_landmark = Flatten(pose.solution.base_from_landmark);
  return pose.solution.ok;
}

PoseSolution PoseRefinement::SolutionOf(const RefinedPose& pose, bool coarse,
                                        const PoseSolverOptions& solver) const {
  const Eigen::Isometry3d at = Lift(pose.base_from_landmark);
  std::vector<const CameraModel*> cameras;
  for (const CameraView& view : views_) cameras.push_back(view.camera);
  return SolvePose(model_, cameras, Observations(model_, pose.association, views_, at, coarse), at, solver);
}

/// Removes edges of something else: an image edge beside the right one can lie within the gate, and be
/// farther off than shadow and blur put an edge when all others agree on the pose.
bool PoseRefinement::DropWrong(RefinedPose& pose) const {
  for (int dropped = 0;; ++dropped) {
    if (!Solve(options_.rough_edge_px, pose)) return false;
    const EdgeSuspect& suspect = pose.solution.suspect;
    if (suspect.misfit < options_.outlier_misfit || dropped == options_.max_outliers) return true;
    pose.association.Withdraw(model_, suspect.edge, suspect.camera);
    if (pose.association.matches.size() < std::size_t(options_.min_matched)) return false;
  }
}

/// Measures by edges as sharp as they should be, without the few that shadow or blur has moved; where most
/// are moved, edges are as unsharp as they show themselves.
void PoseRefinement::Adjust(RefinedPose& pose) const {
  if (pose.solution.misfit > options_.max_misfit) return;
  const RefinedPose rough = pose;
  bool ok = SetAside(options_.solver.edge_sigma_px, pose);
  const double sharp_chi_squared = pose.solution.chi_squared;
  for (const double unsharp : {4, 12}) {
    if (ok && pose.solution.misfit <= options_.max_misfit) break;
    pose = rough;
    ok = SetAside(unsharp * options_.solver.edge_sigma_px, pose);
  }
  pose.sharp_chi_squared = sharp_chi_squared;
}

bool PoseRefinement::SetAside(double edge_sigma_px, RefinedPose& pose) const {
  for (int aside = 0;; ++aside) {
    if (!Solve(edge_sigma_px, pose)) return false;
    const EdgeSuspect& suspect = pose.solution.suspect;
    if (suspect.misfit < options_.outlier_misfit || aside == options_.max_outliers) return true;
    pose.association.SetAside(suspect.edge, suspect.camera);
    if (pose.association.Measuring() < options_.min_matched) return false;
  }
}

}  // namespace priamos::head
