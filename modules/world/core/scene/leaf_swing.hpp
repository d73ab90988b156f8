#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"

namespace priamos::world {

/// Somebody moves a door's leaf, or the wind does.
struct LeafSwing {
  double at_s = 0;          ///< since the world began
  double to_deg = 90;       ///< opening angle that it is moved to
  double speed_deg_s = 45;  ///< a person opens a door by 90 degrees in 2 s

  void Describe(Archive& a);
};

/// A leaf that is moved, with what its angle follows from.
struct MovedLeaf {
  DoorPlan door;  ///< as built
  std::string hinge;
  double thickness_m = 0.04;
  std::string solid;  ///< name of its solid
  std::vector<LeafSwing> swings;
};

}  // namespace priamos::world
