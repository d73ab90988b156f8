#pragma once

#include <Eigen/Geometry>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "world/core/lighting.hpp"
#include "world/core/mesh.hpp"

namespace priamos::world {

/// The laser that draws a line across the floor before the robot, for the third camera to see (section 2 of
/// the paper): a fan of light in one plane.
struct LaserBuild {
  double x_m = 0.46, y_m = 0, z_m = 0.60;  ///< where the fan begins, base frame
  double roll_rad = 0, yaw_rad = 0;        ///< of the fan
  double pitch_rad = 0.35;                 ///< its middle looks down by this
  double half_angle_rad = 0.6;             ///< from its middle to its sides
  double thickness_m = 0.004;              ///< of the sheet of light

  void Describe(Archive& a);
  /// The plane of the light in the base frame.
  Eigen::Hyperplane<double, 3> Plane() const;
};

/// Adds the line as thin strips on every surface that the light reaches; what stands in the light has a
/// shadow.
void AppendLaser(const LaserBuild& laser, const Pose2& map_from_base, const Lighting& surfaces, Mesh& mesh);

}  // namespace priamos::world
