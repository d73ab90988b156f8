#pragma once

#include <vector>

#include "common/ground_plan.hpp"
#include "common/learned/learned_door.hpp"
#include "common/learned/learned_object.hpp"

namespace priamos::planner {

/// The doors of a plan and those that were learned, as places where what the head saw may be a jamb, the
/// frame or the leaf of the door: nothing of its own that a way would have to go around.
class Doorways {
 public:
  Doorways(const std::vector<DoorPlan>& drawn, const std::vector<LearnedDoor>& learned);

  /// Whether a thing reaches into a door's opening or its jambs, or can be its leaf, open to either side.
  bool Has(const LearnedObject& object) const;

 private:
  struct Doorway {
    Pose2 map_from_door;
    double width_m, thickness_m;
  };
  static bool ReachesInto(const Rectangle& footprint, const Doorway& door);
  static bool IsLeaf(const LearnedObject& object, const Doorway& door);

  std::vector<Doorway> doors_;
};

}  // namespace priamos::planner
