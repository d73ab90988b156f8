#pragma once

#include <vector>

#include "head/core/calibration/resection/camera_refinement.hpp"
#include "head/core/camera/head_model.hpp"

namespace priamos::head {

/// Discs of the reference object that one camera saw at one setting.
struct HeadView {
  HeadSetting setting;
  int exposure = 0;  ///< views of the same exposure share where the axes truly stood
  int camera = 0;
  std::vector<DiscObservation> discs;  ///< in the base frame
};

/// Prior knowledge of the head: its drawing, the drawing's errors, and the repeatability of the motors.
struct HeadKnowledge {
  HeadGeometry drawing;
  double length_sigma_m = 0.005, angle_sigma_rad = 0.02;
  double pupil_m = 0.02, pupil_sigma_m = 0.03;
  double repeatability_rad = 0.00005;  ///< standard deviation of an axis at rest at the same counter
  LensKnowledge lens;
};

/// The calibrated head and its residuals.
struct HeadCalibration {
  HeadModel model;
  double mean_error_px = 0;                   ///< F over all views
  std::vector<double> view_error_px;          ///< F of every view
  std::vector<Eigen::Vector2d> residuals_px;  ///< measured minus computed, view after view
};

/// Calibrates mechanics and lenses of the head together from views at several pan, tilt, vergence, zoom and
/// focus settings: least squares over the geometry, one LensState per zoom and focus setting and camera
/// (smooth from node to node), and small errors of the motors at every exposure. In two passes because of the
/// centroids' bias.
///
/// The zoom and focus settings of left and right camera must form a complete grid each. Refuses what does
/// not determine the head, and a fit worse than 1 px.
Outcome<HeadCalibration> SolveHead(const std::vector<HeadView>& views, const HeadKnowledge& known = {});

}  // namespace priamos::head
