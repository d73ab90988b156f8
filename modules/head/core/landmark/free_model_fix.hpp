#pragma once

#include <Eigen/Geometry>
#include <span>

#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/landmark/polyhedron.hpp"

namespace priamos::head {

/// Settings of the search for a free model around its believed pose.
struct FreeModelOptions {
  std::vector<double> gates_px{16, 8, 4, 2, 1.2};  ///< gate of each pass, from the belief to the result
  /// Factors on all gates but the last, tried one after the other if the first search does not find it.
  std::vector<double> retries{1.7, 0.6};
  int min_matched = 5;     ///< edges that must be found, all images together
  double min_share = 0.4;  ///< share of the visible length that must be found
  double max_misfit = 4;
  double outlier_misfit = 9;
  int max_outliers = 4;
  double max_shift_m = 0.05, max_turn_rad = 0.2;  ///< distance from the belief; farther is "elsewhere"
  PoseSolverOptions solver{.on_floor = false, .edge_sigma_px = 0.03, .max_iterations = 15};
};

/// Where a free model is: all six degrees of freedom.
struct FreeModelFix {
  Verdict verdict = Verdict::kNoImage;
  Eigen::Isometry3d base_from_model = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< PoseSolution::covariance
  int n_matched = 0;
  double residual_px = 0, misfit = 0;
  LandmarkModel seen;              ///< what is visible of it at that pose
  std::vector<EdgeMatch> matches;  ///< edges of `seen`
};

/// Finds a body of flat faces in one or more images of the same moment, near `believed`. What is hidden there
/// is not looked for. Answers kFound, or why not: no usable image, nothing of it visible, too few edges
/// found, the model does not fit, elsewhere.
FreeModelFix LocateFreeModel(const Polyhedron& body, const Eigen::Isometry3d& believed,
                             std::span<const CameraView> views, const FreeModelOptions& options);

}  // namespace priamos::head
