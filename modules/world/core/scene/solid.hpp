#pragma once

#include <Eigen/Core>
#include <string>

#include "common/geometry.hpp"

namespace priamos::world {

/// One upright box of the scene. Walls, jambs, door leaf, skirting, posters and furniture are all solids:
/// the renderer draws them, the sonars hear them, the footprint touches them.
struct Solid {
  std::string name;        ///< for messages, e.g. "left jamb"
  Pose2 map_from_solid;    ///< centre of its base
  Eigen::Vector2d size_m;  ///< full length along its x and y axis
  double z_min_m = 0, z_max_m = 0;
  std::string material;  ///< key into the scene's materials: how it looks and how it echoes
};

}  // namespace priamos::world
