#pragma once

#include <span>
#include <vector>

#include "head/core/calibration/resection/triangulation.hpp"
#include "head/core/calibration/targets/camera_calibration.hpp"

namespace priamos::head {

/// F (equation 7) of points that took no part in the calibration: F of the points that did falls when points
/// are dropped, and does not measure the errors between them.
struct PredictionErrors {
  double leave_one_out_px = 0;  ///< every point predicted from all others
  double held_out_px = 0;       ///< a quarter predicted from the other three, for each quarter
  int failed = 0;               ///< calibrations without these points that were not possible
};

/// Recalibrates without single points and without quarters of them.
PredictionErrors PredictHeldOut(const std::vector<DiscObservation>& observations,
                                const LensKnowledge& lens = {});

/// Distances between known points and their reconstruction by several cameras [m].
struct ReconstructionErrors {
  int points = 0;  ///< seen by at least two cameras
  double mean_m = 0, rms_m = 0, max_m = 0;
};

/// One point with its image in some of the cameras.
struct SeenPoint {
  Eigen::Vector3d point_m;
  std::vector<Ray> rays;
};

/// The experiment of section 3.1.5 of the paper: the calibration object as test object of reconstruction.
ReconstructionErrors Reconstruct(std::span<const SeenPoint> points);

/// The discs that two or more calibrations saw, with the bias of their centroids taken off. Discs are
/// identified by their place.
std::vector<SeenPoint> CommonPoints(std::span<const CameraCalibration> cameras);

}  // namespace priamos::head
