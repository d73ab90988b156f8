#pragma once

#include <optional>
#include <span>

#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/look/far_edges.hpp"

namespace priamos::head {

/// When far edges tell a heading.
struct FarSightOptions {
  double min_length_px = 25;
  double lean_rad = 0.03;          ///< largest angle of a plane of sight to the vertical
  double camera_sigma_px = 0.1;    ///< error of the calibration, added to the noise of the edges
  double same_for_all_px = 0.3;    ///< what of that error all edges of a look have in common
  double place_sigma_m = 0.003;    ///< added to what is known of the edges' places
  double min_evidence = 6;         ///< natural logarithm, over chance
  double min_lead = 3;             ///< over the next best heading
  int min_edges = 3;               ///< that agree
  double sigmas = 4;               ///< of the prediction: how far off a heading is searched
  double least_reach_rad = 0.012;  ///< and at least so far
};

/// The heading of the base by what stands beyond a landmark that is too near to be seen: a fix of the
/// landmark, of which the bearings of far edges tell the direction and next to nothing of the place. Its
/// covariance says both, in the frame of the base: the place is known ten times less well than `expected` has
/// it, and correlated with the direction as parallax has it. n_matched: edges of images; verdict
/// kTooFewEdges: they do not tell one heading.
LandmarkFix SeeFar(const FarEdges& far, const LandmarkPrediction& expected, std::span<const CameraView> views,
                   const FarSightOptions& options = {});

}  // namespace priamos::head
