#pragma once

#include <optional>
#include <vector>

#include "common/ground_plan.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// A door, and the way to a place from which the head sees it well.
struct DoorView {
  DoorPlan door;     ///< from the side where the base is; its id is that of the landmark there
  PlannedPath path;  ///< map frame
};

/// Finds doors whose sight tells places apart: at one of them there is a door, at the others there is none at
/// the same place relative to the robot. Doors of one kind look alike, so a door tells nothing where each of
/// the places has one there.
class DoorViews {
 public:
  DoorViews(const RoutePlannerConfig& config, const Footprint& footprint, const GroundPlan& plan);

  /// The nearest such view for a base at `place`, were it there, against the other places; `seen`: landmarks
  /// that are left out. nullopt: none can be reached without passing a door.
  std::optional<DoorView> Nearest(const Pose2& place, const std::vector<Pose2>& others,
                                  const std::vector<int>& seen) const;
  /// Whether a door is seen from `place` where there is none from any of the others.
  bool TellsApart(const DoorPlan& door, const Pose2& place, const std::vector<Pose2>& others) const;

 private:
  std::optional<PlannedPath> WayBefore(const DoorPlan& door, const Pose2& place) const;

  RoutePlanner planner_;
  std::vector<DoorPlan> doors_;  ///< from either side
};

}  // namespace priamos::planner
