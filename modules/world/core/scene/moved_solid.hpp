#pragma once

#include <cstddef>

#include "common/geometry.hpp"

namespace priamos::world {

/// Where a solid is now that moves by itself.
struct MovedSolid {
  std::size_t solid = 0;  ///< place in the list of all solids
  Pose2 map_from_solid;
};

}  // namespace priamos::world
