#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "common/outcome.hpp"
#include "planner/core/path/door_planner.hpp"
#include "planner/core/path/footprint.hpp"
#include "planner/core/path/planned_path.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// One piece of a way through a building: a drive to a place, or the passage of a door.
struct Leg {
  std::optional<int> door_id;  ///< door of the plan to pass; nullopt: a drive to `goal`
  Goal goal{};                 ///< where the leg ends
  double length_m = 0;         ///< on the planned path
};

/// How a way through doors is made.
struct DoorRouterConfig {
  double before_m = 2.5;   ///< place on a door's axis from which it is passed, if there is room ...
  double slant_deg = 27;   ///< ... unless the base stands before the door already, no more aside of its axis
  double turned_deg = 45;  ///< ... and no more turned than this
  double door_costs_m = 10;  ///< a door costs as much as so long a detour

  void Describe(Archive& a);
};

/// The way from a place to another one in a building: through rooms as the RoutePlanner drives, through doors
/// as the DoorPlanner passes them. The places before and behind each door are the nodes of a graph, doors and
/// the routes between those places its edges; a route is searched when the shortest way may need it. Those
/// between doors are kept, since the plan does not change.
class DoorRouter {
 public:
  DoorRouter(const DoorRouterConfig& config, const RoutePlannerConfig& route,
             const DoorPlannerConfig& passage, const Footprint& footprint, const GroundPlan& plan);

  /// The legs to a goal, at least one: the last one ends there. Refuses with the reason.
  Outcome<std::vector<Leg>> Plan(const Pose2& map_from_start, const Goal& goal);
  /// The legs to a door and through it, from the side to which the way is shorter. They may be the door
  /// alone, although it cannot be passed from there: why not is the door mission's to say.
  std::vector<Leg> PlanThrough(const Pose2& map_from_start, int door_id);
  /// Where the base stands when it has come into the cabin of a door; nullopt: it leads into none.
  std::optional<Pose2> PlaceInCabin(int door_id) const;
  /// Name of a door of the plan; its number when there is none.
  std::string NameOf(int door_id) const;

 private:
  /// A door as it is passed from one side.
  struct Passage {
    DoorPlan door;                ///< as seen from that side
    int door_id = 0;              ///< in the plan
    std::optional<Pose2> before;  ///< where its passage begins; nullopt: it cannot be passed from there
    Pose2 behind;                 ///< where it ends
    std::vector<Pose2> nearer{};  ///< where it may begin instead, farthest from the door first
    bool is_cabin = false;        ///< it leads out of a cabin, in which `before` is the only place
  };
  class Search;

  void AddPassage(const DoorPlan& door, int door_id);
  std::vector<Pose2> PlacesBefore(const DoorPlan& door) const;
  bool CanBegin(const Passage& passage, const Pose2& map_from_base) const;
  bool StandsBefore(const Passage& passage, const Pose2& map_from_base) const;
  /// Length of the drive to where `passage` can begin; 0 where it can at once.
  std::optional<double> LengthTo(const Passage& passage, const Pose2& from) const;
  std::optional<double> LengthBetween(std::size_t from_passage, std::size_t to_passage);
  std::vector<Leg> LegsThrough(const Passage& passage, const Pose2& from);
  void AppendLegs(const Passage& passage, const Pose2& from, double to_door_m, std::vector<Leg>& legs) const;

  DoorRouterConfig config_;
  RoutePlanner route_;
  DoorPlanner passage_;
  std::vector<Passage> passages_;
  std::vector<std::string> closed_;  ///< why doors cannot be passed from a side
  std::map<std::pair<std::size_t, std::size_t>, std::optional<double>> between_;
};

}  // namespace priamos::planner
