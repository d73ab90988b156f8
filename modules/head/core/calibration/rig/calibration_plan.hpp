#pragma once

#include <vector>

#include "common/archive.hpp"
#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// An interval of motor steps and how many nodes to calibrate in it, ends included.
struct StepInterval {
  int first = 0, last = 2000;
  int nodes = 5;

  void Describe(Archive& a);
  /// Ascending and without repetition.
  std::vector<int> Steps() const;
};

/// Which settings the unattended calibration visits: all a person has to give is the interval of zoom and
/// focus (section 3.1.4 of the paper). The reference object must stay in the images at all of them.
struct CalibrationPlan {
  double pan_deg = 12, tilt_deg = 7;  ///< the mechanics are calibrated at these, their negatives and 0
  double vergence_deg = 5;        ///< the mechanics are calibrated at this of each camera, its negative and 0
  double convergence_deg = 1.15;  ///< vergence of both cameras where it does not matter
  /// Every node of zoom and focus is seen twice, the object in opposite corners of the picture: at both signs
  /// of these at the shortest focal length, of `grid_tele_share` of them at the longest.
  double grid_pan_deg = 10, grid_tilt_deg = 8, grid_tele_share = 0.2;
  StepInterval zoom{.first = 50, .last = 1850, .nodes = 7};
  StepInterval focus{.first = 1000, .last = 2000, .nodes = 4};

  void Describe(Archive& a);
  /// All settings in the order in which they are visited: mechanics first, at the shortest focal length, then
  /// the grid from the largest zoom down, as motors move least.
  std::vector<HeadSetting> Settings() const;
};

}  // namespace priamos::head
