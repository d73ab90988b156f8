#pragma once

#include <vector>

#include "common/frame_store.hpp"
#include "head/core/calibration/targets/camera_calibration.hpp"

namespace priamos::head {

/// A flat target: a regular grid of dots. Its frame: x along a row, y along a column, z out of the dots.
struct DotTarget {
  int columns = 6, rows = 6;
  double spacing_m = 0.03;
  double radius_m = 0.01;
  bool dark = true;  ///< dark dots on light ground, else the other way
};

/// The dots of one photograph, as observations in the target's frame. Which corner is the first is not known
/// of a regular grid; any is as good as another for calibrating a camera. Refuses a photograph in which the
/// grid is not found as a whole.
Outcome<std::vector<DiscObservation>> FindDots(const GreyImage& photograph, const DotTarget& target);

/// One camera from several photographs of a flat target at different slants: Zhang's method for a start, then
/// all photographs together, with the centroids' bias taken off. Refuses fewer than 3 photographs (what one
/// plane determines of a lens is ambiguous) and a fit worse than `lens` allows.
Outcome<std::vector<CameraCalibration>> CalibrateFromPlanes(
    const std::vector<std::vector<DiscObservation>>& photographs, int width_px, int height_px,
    const LensKnowledge& lens);

/// F of one photograph of a flat target when lens and matrix of `lens` are given and only the pose of the
/// target is sought: what the calibration of other photographs is worth for this one.
Outcome<double> ErrorWithLens(const std::vector<DiscObservation>& photograph, const CameraModel& lens);

}  // namespace priamos::head
