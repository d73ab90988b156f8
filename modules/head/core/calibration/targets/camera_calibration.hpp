#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "head/core/calibration/correspondence/correspondence.hpp"
#include "head/core/calibration/resection/camera_refinement.hpp"

namespace priamos::head {

/// One camera calibrated from one image of the reference object.
struct CameraCalibration {
  CameraModel model;  ///< in the base frame
  int discs = 0;
  double mean_error_px = 0;  ///< F, equation 7 of the paper, of the refined model
  double dlt_error_px = 0;   ///< F of the plain DLT matrix of equations 1-6, before distortion is modelled
  std::vector<DiscObservation> observations;  ///< in the base frame
  std::vector<Eigen::Vector2d> residuals_px;  ///< measured minus computed, for every observation
};

/// The procedure of section 3.1 of the paper on discs whose places are known: DLT matrix by least squares,
/// refined with lens distortion; then once more with the bias of the centroids, which the first pass makes
/// known, taken off. Refuses too few discs, degenerate arrangements, and a fit worse than `lens` allows.
Outcome<CameraCalibration> CalibrateFromDiscs(const std::vector<DiscObservation>& observations,
                                              const LensKnowledge& lens = {});

/// The observations that a labelled image gives, in the base frame.
std::vector<DiscObservation> ObserveDiscs(const std::vector<DetectedDisc>& detections,
                                          const Labelling& labelling, const ReferenceObject& object,
                                          const Eigen::Isometry3d& base_from_object);

/// All of it from an image: discs found, recognised, and used.
Outcome<CameraCalibration> CalibrateCamera(const GreyImage& image, const ReferenceObject& object,
                                           const DiscLabeller& labeller,
                                           const Eigen::Isometry3d& base_from_object,
                                           const LensKnowledge& lens = {});

/// Calibrations of one camera at one zoom and focus, made better by each other: the lens is the same in all.
/// Refuses what RefineViews refuses.
Outcome<std::vector<CameraCalibration>> ShareLens(std::vector<CameraCalibration> views,
                                                  const LensKnowledge& lens = {});

}  // namespace priamos::head
