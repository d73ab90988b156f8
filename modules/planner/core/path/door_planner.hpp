#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/ground_plan.hpp"
#include "common/outcome.hpp"
#include "planner/core/path/footprint.hpp"
#include "planner/core/path/planned_path.hpp"
#include "planner/core/path/swept_footprint.hpp"

namespace priamos::planner {

/// Clearances and distances of paths to a door and through it. Distances along the door's axis are from the
/// middle of the opening to the base centre.
struct DoorPlannerConfig {
  double door_margin_m =
      0.01;  ///< planned clearance to each jamb, in addition to the uncertainty of the pose
  double wall_margin_m = 0.10;  ///< planned clearance everywhere else
  double align_m = 1.6;         ///< preferred place to be on the axis, straight
  double align_least_m = 1.15;  ///< nearest such place
  double goal_m = 1.5;          ///< goal behind the door, where there is room
  double approach_m = 2.0;      ///< place on the axis that the approach leads to
  double hold_m = 1.1;          ///< free distance between footprint and wall where the approach ends

  void Describe(Archive& a);
};

/// Plans paths for a holonomic rectangular base: straight lines along which the heading turns evenly, every
/// one checked by sweeping the true footprint along it. A circle around the 78 cm wide footprint would not
/// fit a 90 cm door.
class DoorPlanner {
 public:
  DoorPlanner(const DoorPlannerConfig& config, const Footprint& footprint, const GroundPlan& plan);

  /// Why no path can lead through this door, wherever the robot stands; nullopt when it fits.
  std::optional<Refusal> CheckDoor(const DoorPlan& door) const;

  /// Path from `map_from_start` through the door. Tried in this order: straight to a place on the axis before
  /// the door (the farther from it the better), a side-step, backing off first.
  Outcome<PlannedPath> PlanPassage(const DoorPlan& door, const Pose2& map_from_start) const;

  /// Path from `map_from_start` to the place before the door where the robot may wait while it does not know
  /// its pose well: over the axis at approach_m if that is ahead, and to the hold point.
  Outcome<PlannedPath> PlanApproach(const DoorPlan& door, const Pose2& map_from_start) const;

  /// Path from `map_from_start`, between the hold point and the plane behind the door, straight back to the
  /// hold point, or into the cabin: over what the robot has just left free.
  Outcome<PlannedPath> PlanRetreat(const DoorPlan& door, const Pose2& map_from_start) const;

  /// Path from `map_from_start` straight back to the door's axis, so far before the door [m].
  Outcome<PlannedPath> PlanStandBack(const DoorPlan& door, const Pose2& map_from_start,
                                     double distance_m) const;

  /// Where a base stands that has come into a cabin and has yet to turn: with walls ahead and on both sides,
  /// and no room from which the door could be looked at on the way out. `door` as who leaves has it before
  /// him; nullopt: he leaves no cabin.
  std::optional<Pose2> CabinPlace(const DoorPlan& door) const;

  /// Path out of a cabin, forwards or backwards as the base stands: onto the door's axis, and straight
  /// through.
  Outcome<PlannedPath> PlanLeave(const DoorPlan& door, const Pose2& map_from_start) const;

  /// Coordinate x of the hold point in the door's frame [m], negative.
  double HoldX(const DoorPlan& door) const;
  /// Coordinate x in the door's frame from which on the whole footprint is behind the wall [m].
  double PastX(const DoorPlan& door) const;
  /// Coordinate x of the goal behind the door [m]: goal_m, or the middle of what a wall ahead leaves free.
  double GoalX(const DoorPlan& door) const;
  /// Width that the footprint needs at least [m].
  double NeededWidth() const { return space_.footprint().width_m + 2 * config_.door_margin_m; }

 private:
  std::optional<Refusal> CheckStart(const DoorPlan& door, const Pose2& map_from_start) const;
  /// Checks start -> points; all but the last `n_tight` legs with the wall margin, and with leeway.
  Outcome<PlannedPath> CheckPath(const Pose2& start, std::vector<Pose2> points, std::size_t n_tight) const;
  std::vector<std::vector<Pose2>> PassageCandidates(const DoorPlan& door, const Pose2& door_from_start) const;

  DoorPlannerConfig config_;
  SweptFootprint space_;
};

}  // namespace priamos::planner
