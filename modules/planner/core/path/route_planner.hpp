#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "common/outcome.hpp"
#include "planner/core/map/learned_obstacles.hpp"
#include "planner/core/path/narrow_passages.hpp"
#include "planner/core/path/planned_path.hpp"
#include "planner/core/path/route_search.hpp"
#include "planner/core/path/swept_footprint.hpp"

namespace priamos::planner {

/// Clearances of routes.
struct RoutePlannerConfig {
  double easy_margin_m = 0.30;   ///< preferred clearance to everything
  double least_margin_m = 0.10;  ///< clearance where there is no such route
  double least_leeway_m = 0;     ///< how far any line may be left at least, but in a narrow passage
  RouteCosts costs{};
  int most_poses = 0;  ///< looked at for either; 0: all

  void Describe(Archive& a);
};

/// The way through a room for a holonomic rectangular base: among walls, door frames, cupboards, leaves that
/// the plan gives, and what else is known. A doorway whose leaf is not known counts as closed: passing one is
/// a mission of its own.
class RoutePlanner {
 public:
  RoutePlanner(const RoutePlannerConfig& config, const Footprint& footprint, const GroundPlan& plan);

  /// Takes something into account that is not on the plan, until Forget().
  void Add(std::string name, const Rectangle& shape);
  /// Takes these into account in place of all that was added before; but none where the base stands, which
  /// is known by one side only. No passage is looked for beside what is `unknown`.
  void Take(std::vector<NamedObstacle> obstacles, const Pose2& map_from_base,
            std::vector<NamedObstacle> unknown = {});
  void Forget();
  /// Takes the walls and things into account that are not on the plan, in place of those before; but none
  /// where the base stands: there is nothing.
  void Learn(const LearnedWalls& learned, const Pose2& map_from_base);

  /// Straight lines with evenly turning heading to the goal, as few as there may be; each but the last 60 cm
  /// with its leeway, which says of some that they lead through a narrow passage. Refuses with the reason.
  Outcome<PlannedPath> Plan(const Pose2& map_from_start, const Goal& goal) const;
  /// The same without a reason, which may take longer to find than a path.
  std::optional<PlannedPath> FindPath(const Pose2& map_from_start, const Goal& goal) const;
  /// Whether the base may stand there.
  bool IsFree(const Pose2& map_from_base) const {
    return space_.DistanceAt(map_from_base) >= config_.least_margin_m;
  }
  /// Whether the lines from a start to `points` touch nothing.
  bool AreFree(const Pose2& map_from_start, const std::vector<Pose2>& points) const {
    return InTheWay(map_from_start, points).empty();
  }
  /// Name of what the first of these lines that is not free touches; empty: nothing is in the way.
  std::string InTheWay(const Pose2& map_from_start, const std::vector<Pose2>& points) const;
  /// How far each of these lines may be left: by so much, but in a narrow passage.
  std::vector<Leeway> LeewayInPassages(const Pose2& map_from_start, const std::vector<Pose2>& points,
                                       const Leeway& elsewhere) const;
  /// Why no route can begin or end there, whatever lies between.
  std::optional<Refusal> CheckEnds(const Pose2& start, const Goal& goal) const;

 private:
  std::optional<PlannedPath> FindPath(const Pose2& map_from_start, const Goal& goal, double wanted_m) const;
  void Rebuild();
  void EraseUnder(const Pose2& map_from_base, std::vector<NamedObstacle>& obstacles) const;
  std::vector<Pose2> Straightened(const std::vector<Pose2>& route, double margin_m) const;
  PlannedPath PathAlong(const Pose2& start, std::vector<Pose2> corners) const;
  bool IsNarrow(const Pose2& from, const Pose2& to) const;
  Leeway LeewayOf(const Pose2& from, const Pose2& to, bool exact) const;
  std::optional<Refusal> CheckSize(const Pose2& start, const Goal& goal) const;
  Refusal NoWay(const Pose2& start, const Goal& goal) const;

  RoutePlannerConfig config_;
  std::vector<DoorPlan> doors_;   ///< of the plan
  std::vector<DoorPlan> closed_;  ///< those whose leaf is not known
  std::vector<NamedObstacle> added_, unknown_, learned_;
  std::vector<NarrowPassage> passages_;  ///< of all that is known
  SweptFootprint known_;                 ///< the plan
  SweptFootprint space_;                 ///< and what was added
  SweptFootprint slim_;                  ///< a body that fits through every door, all of them open
};

}  // namespace priamos::planner
