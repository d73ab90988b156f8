#pragma once

#include <Eigen/Geometry>

#include "common/frame_store.hpp"
#include "head/core/calibration/correspondence.hpp"
#include "head/core/calibration/outcome.hpp"
#include "head/core/calibration/reference_object.hpp"
#include "head/core/camera_model.hpp"

namespace priamos::head {

/// One camera as one picture of the reference object shows it.
struct CameraCalibration {
  CameraModel model;         ///< in the base frame
  int discs = 0;             ///< found and labelled
  double mean_error_px = 0;  ///< F of equation 7, on undistorted points without the discs' bias
};

/// From a picture to a camera: finds and labels the discs, fits the lens, takes the distortion and the bias
/// of the discs' centroids out of the measured points, and solves equations 1-6 for the DLT matrix. `object`
/// is in its own frame, as the labeller's; `base_from_object` is where it stands.
Outcome<CameraCalibration> CalibrateCamera(const GreyImage& image, const ReferenceObject& object,
                                           const DiscLabeller& labeller,
                                           const Eigen::Isometry3d& base_from_object);

}  // namespace priamos::head
