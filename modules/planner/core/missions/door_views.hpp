#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// A door, and the way to a place from which the head sees it well.
struct DoorView {
  DoorPlan door;         ///< from the side where the base is; its id is that of the landmark there
  Pose2 door_from_base;  ///< at that place
  PlannedPath path;      ///< map frame; empty: the base is there
};

/// A place from which a door was looked at, or that could not be reached.
struct SpentView {
  int door_id = 0;
  Pose2 door_from_base;
};

/// What nobody sees through, map frame.
struct ScreenLine {
  Eigen::Vector2d from{0, 0}, to{0, 0};
};

/// Finds doors whose sight tells places apart: at one of them there is a door, at others there is none at the
/// same place relative to the robot. Doors of one kind look alike, so a door tells nothing of places that
/// have one there, too.
class DoorViews {
 public:
  /// Whether the two sides of a door count as alike: to who only knows that a door is there, or as the head
  /// sees them, which has another model for each.
  enum class Sides { kAlike, kDiffer };

  DoorViews(const RoutePlannerConfig& config, const Footprint& footprint, const GroundPlan& plan);

  /// What else than the plan is around a base at `place`: walls that were heard, and things. None of it is
  /// where the base stands.
  /// No way leads through `echoes` either, but they hide nothing: they are known as points.
  void Know(const LearnedWalls& heard, const std::vector<Rectangle>& things,
            const std::vector<Rectangle>& echoes, const Pose2& place);
  /// The best such view for a base at the end of `trail`, on which it came, were it there, against the other
  /// places, apart from `spent` ones: near by, at no slant, with nothing known before the door, and telling
  /// it from many. Map frame. nullopt: none can be reached without passing a door.
  std::optional<DoorView> Best(const std::vector<Pose2>& trail, const std::vector<Pose2>& others,
                               const std::vector<SpentView>& spent, Sides sides = Sides::kAlike) const;
  /// The best such view from where the base stands, as it stands, past all that is known to hide it.
  std::optional<DoorView> Here(const Pose2& place, const std::vector<Pose2>& others,
                               const std::vector<SpentView>& spent, Sides sides = Sides::kAlike) const;
  /// Whether the plan has a door there, or so near that who knows his place to some decimetres takes it for
  /// that.
  bool HasDoor(const Pose2& map_from_door) const;
  /// Whether the head sees a door from there, were nothing before it.
  static bool IsInSight(const Pose2& door_from_base);
  /// Whether the two could be taken for each other so, by their place.
  static bool AreAtOnePlace(const Pose2& a, const Pose2& b);

 private:
  /// A place from which a door may be seen; one of the trail is reached as the base came.
  struct Spot {
    const DoorPlan* door = nullptr;
    Pose2 there;  ///< map_from_base
    double cost = 0;
    std::optional<std::size_t> of_trail{};
  };
  std::size_t CountAlike(const DoorPlan& door, const Pose2& place, const std::vector<Pose2>& others,
                         Sides sides) const;
  bool Tells(const DoorPlan& door, const Pose2& place, const std::vector<Pose2>& others, Sides sides) const;
  bool IsView(const DoorPlan& door, const Pose2& there, const std::vector<SpentView>& spent) const;
  bool IsBehind(const DoorPlan& side) const;
  double CostOf(const DoorPlan& door, const Pose2& there, const std::vector<SpentView>& spent) const;
  void AddSpots(const DoorPlan& door, const Pose2& place, const std::vector<SpentView>& spent,
                std::vector<Spot>& spots) const;
  void AddTrail(const DoorPlan& door, const std::vector<Pose2>& trail, const std::vector<SpentView>& spent,
                std::vector<Spot>& spots) const;
  std::optional<PlannedPath> WayTo(const Spot& spot, const std::vector<Pose2>& trail) const;

  RoutePlanner planner_;
  std::vector<DoorPlan> doors_;      ///< from either side
  std::vector<int> behind_;          ///< numbers of those that are far sides, as the plan draws them
  std::vector<ScreenLine> walls_;    ///< of the plan
  std::vector<ScreenLine> screens_;  ///< what else may hide a door
};

}  // namespace priamos::planner
