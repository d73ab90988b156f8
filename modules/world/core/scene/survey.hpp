#pragma once

#include <cstdint>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"

namespace priamos::world {

struct WorldPlan;

/// How wrong the map is: whoever measured the building had a tape and a few hours. Drawn from the seed for
/// each door, and told to nobody.
struct SurveyPlan {
  double place_m = 0;       ///< a door and its wall are off by up to this, along each axis
  double yaw_deg = 0;       ///< they are turned by up to this
  double size_sigma_m = 0;  ///< sigma of every dimension of a door, cut off at three of them
  double narrower_m = 0;    ///< its opening is narrower by up to this, in addition

  void Describe(Archive& a);
};

/// The doors of the map as they were built, in its order: with the errors of the world's survey and what the
/// world says of each door.
std::vector<DoorPlan> BuiltDoors(const GroundPlan& map, const WorldPlan& plan, std::uint64_t seed);

}  // namespace priamos::world
