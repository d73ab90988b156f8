#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "head/core/bodies/free_model_options.hpp"
#include "head/core/bodies/guided_views.hpp"
#include "head/core/bodies/polyhedron.hpp"
#include "head/core/landmark/edge_association.hpp"

namespace priamos::head {

/// Everything that is known of a body at one pose.
struct BodyState {
  Eigen::Isometry3d base_from_model;
  LandmarkModel seen{};
  std::shared_ptr<const GuidedViews> guided{};  ///< nullptr: compared with the images as they were given
  Association association{};
  PoseSolution solution{};
  double variance_scale = 1;  ///< variance of the edges over the one that is expected of them

  /// Log odds of the body there, with what the model had to be bent for it, by a variance of the edges that
  /// is `unit` times as large as expected, and with what it says for the pose that the edges fit more
  /// precisely than expected.
  double LogOdds(double unit) const;
};

/// The variance of the edges over the expected one, where it is larger, of the pose that fits best.
double UnitOf(std::span<const BodyState> states);

/// Fits poses of a body to the images: from pass to pass fewer ones, through narrower gates. In the last
/// passes the images are measured once more along the edges of each pose.
class FreeSearch {
 public:
  /// Keeps references to the first three; `middle` is that of the body, landmark frame, `distance_m` how far
  /// it is from the first camera.
  FreeSearch(const Polyhedron& body, std::span<const CameraView> views, const FreeModelOptions& options,
             const Eigen::Vector3d& middle, double distance_m);

  /// The different poses after the first pass, best first, also those at which few edges were found.
  std::vector<BodyState> Roughly(std::span<const Eigen::Isometry3d> poses);
  /// What the other passes leave of these, best first; those that lost too many edges are dropped.
  std::vector<BodyState> Refine(std::vector<BodyState> states);
  /// A pose as it is, compared with the images.
  BodyState LookAt(const Eigen::Isometry3d& pose);

  double blur_px() const { return blur_px_; }  ///< of the least sharp image
  /// One for each view, or none if an image is not at hand.
  std::span<const StepMeter> meters() const { return meters_; }

 private:
  struct Pass;
  /// To the ends of lines, or to all their points, also looking for the edge that contradicts the others.
  enum class Fitted { kRoughly, kFinely, kWithSuspect };

  void Refine(const Pass& pass, std::vector<BodyState>& states);
  bool Refine(const Pass& pass, BodyState& state);
  void DropRepeated(std::vector<BodyState>& states) const;
  bool IsSame(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const;
  void Look(double gate_px, BodyState& state);
  void Guide(BodyState& state);
  std::span<const CameraView> ViewsOf(const BodyState& state) const;
  bool Solve(double variance_scale, Fitted fitted, BodyState& state) const;
  bool DropOutliers(BodyState& state) const;
  bool FindVariance(BodyState& state) const;
  double LogLikelihood(const PoseSolution& solution, int n_outliers) const;
  double EdgeSigma() const { return options_.solver.edge_sigma_px + 0.12 * blur_px_; }

  const Polyhedron& body_;
  std::span<const CameraView> views_;
  const FreeModelOptions& options_;
  const Eigen::Vector3d middle_;
  const double distance_m_;
  std::vector<const CameraModel*> cameras_;
  std::vector<GuidedEdges> guides_;  ///< one for each view, or none if an image is not at hand
  std::vector<StepMeter> meters_;    ///< the same
  double blur_px_ = 0, model_sigma_px_ = 0, gate_px_ = 0;
};

}  // namespace priamos::head
