#pragma once

#include <span>
#include <vector>

#include "head/core/landmark/edge_association.hpp"
#include "head/core/landmark/model_errors.hpp"
#include "head/core/landmark/pose_solver.hpp"

namespace priamos::head {

/// How a supposed pose is refined, and which edges are measured by.
struct RefinementOptions {
  int min_matched =
      6;  ///< edges that must be found in two images together, and half as many more with a third
  double max_misfit = 3;
  double outlier_misfit = 6;    ///< an edge that fits worse (chi squared per degree of freedom: 0.01 to 0.2 %
                                ///< of the right ones) is an outlier
  double rough_edge_px = 0.15;  ///< so far shadow, blur and neighbours move an edge of the model (1 sigma):
                                ///< an outlier by this is none, one by sharp edges only is not measured by
  int max_outliers = 3;         ///< largest number of edges that are taken out, and of those not measured by
  PoseSolverOptions solver;
};

/// A supposed pose of a landmark on the floor, and what the images say of it.
struct RefinedPose {
  Pose2 base_from_landmark;
  Association association{};
  PoseSolution solution{};
  double edge_sigma_px = 0;      ///< PoseSolverOptions::edge_sigma_px of the solution
  double sharp_chi_squared = 0;  ///< of the solution for which edges are as sharp as they should be

  /// With what the model had to be bent for it: any pose a little beside the right one explains the images
  /// when every edge may be where it is found.
  double LogOdds() const { return association.log_odds - sharp_chi_squared / 2; }
};

/// How near to a proposed pose edges are looked for: the gate of the first pass.
inline constexpr AssociationOptions kProposed{.sigma_px = 2.0, .gate_px = 5.0, .max_angle_rad = 0.06};

/// The edges of a model that a viewer sees at that pose, or just would, `margin_rad` farther on.
std::vector<int> VisibleAt(const LandmarkModel& model, const Pose2& base_from_landmark,
                           double margin_rad = 0);

/// Refines poses of one landmark in the images of one moment: from pass to pass the prediction gets sharper.
class PoseRefinement {
 public:
  /// All are kept by reference.
  PoseRefinement(const LandmarkModel& model, std::span<const CameraView> views,
                 const RefinementOptions& options)
      : model_(model), views_(views), options_(options) {}

  /// The first pass, from a proposal: finds the edges from its pose, the model bent by its edge_shifts. False
  /// if they do not determine a pose.
  bool Approach(RefinedPose& pose) const;
  /// The other passes; the solution is not ok where one fails.
  void Refine(RefinedPose& pose) const;
  /// Looks for the edges from where the pose is now, and measures by them.
  void MatchAgain(RefinedPose& pose) const;
  /// What the solution shows of the errors of the model; empty if it is none.
  ModelErrors Learn(const RefinedPose& pose) const;

 private:
  void Match(const AssociationOptions& gate, RefinedPose& pose) const;
  bool Pass(const AssociationOptions& gate, bool coarse, RefinedPose& pose) const;
  bool Solve(double edge_sigma_px, RefinedPose& pose) const;
  bool DropWrong(RefinedPose& pose) const;
  void Adjust(RefinedPose& pose) const;
  bool SetAside(double edge_sigma_px, RefinedPose& pose) const;
  PoseSolution SolutionOf(const RefinedPose& pose, bool coarse, const PoseSolverOptions& solver) const;

  const LandmarkModel& model_;
  std::span<const CameraView> views_;
  const RefinementOptions& options_;
};

}  // namespace priamos::head
