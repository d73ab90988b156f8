#pragma once

#include "common/archive.hpp"

namespace priamos::head {

/// Standard deviations of the floor's pose in the base frame, and of its measurement: a robot pitches and
/// rolls on its wheels.
struct FloorTolerance {
  double heave_m = 0.002;  ///< height below the robot, joints and ramps included
  double pitch_rad = 0.002, roll_rad = 0.002;
  double rough_m = 0.001;   ///< roughness of the surface, from place to place
  double camera_px = 0.15;  ///< error of the third camera's calibration and of its motors

  void Describe(Archive& a);
};

/// What counts as an obstacle; heights above the floor [m].
struct ObstacleOptions {
  FloorTolerance floor;
  double min_height_m = 0.015;              ///< lower obstacles are driven over
  double lowest_m = -0.5, highest_m = 0.5;  ///< range of heights that is searched, above the floor
  double significance = 5;                  ///< sigmas of the height that an obstacle needs
  int min_columns = 12;                     ///< columns of the picture that an obstacle needs
  int min_missing = 40;                     ///< a gap in a line is reported if it has more columns
  double min_seen = 0.3;  ///< share of columns with a line; with less the floor is not judged

  void Describe(Archive& a);
};

}  // namespace priamos::head
