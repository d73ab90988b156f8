#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/archive.hpp"
#include "common/robot/robot_drawing.hpp"

namespace priamos::world {

/// A laser that draws a line across the floor before the robot, for the third camera to see (section 2 of
/// the paper): a fan of light in one plane.
struct LaserBuild {
  double x_m = kDrawnLaser.x_m, y_m = kDrawnLaser.y_m,
         z_m = kDrawnLaser.z_m;      ///< where the fan begins, base frame
  double roll_rad = 0, yaw_rad = 0;  ///< orientation of the fan, with pitch_rad
  double pitch_rad = 0.35;           ///< its middle looks down by this
  double half_angle_rad = 0.6;       ///< from its middle to its sides
  double thickness_m = 0.004;        ///< thickness of the sheet of light

  void Describe(Archive& a);
  /// Frame of the fan: x along its middle, z across the plane of the light.
  Eigen::Isometry3d BaseFromFan() const;
  /// The plane of the light in the base frame.
  Eigen::Hyperplane<double, 3> Plane() const;
};

/// More would not be told apart in one picture.
inline constexpr std::size_t kMostLasers = 4;

/// Those of KASTOR: the near one meets the floor 2.1 m before the base centre, the far one 3.0 m.
std::vector<LaserBuild> ShippedLasers();

/// The list `[[lasers]]` of a configuration.
void DescribeLasers(Archive& a, std::vector<LaserBuild>& lasers);

}  // namespace priamos::world
