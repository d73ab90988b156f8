#pragma once

#include "common/archive.hpp"
#include "planner/core/explore/exploration.hpp"
#include "planner/core/graph/floor_graph.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// Speed, tolerances and limits of exploring a floor.
struct ExploreMissionConfig {
  double speed_m_s = 0.30;
  double near_m = 0.3;        ///< distance to the goal at which it counts as reached
  double reconsider_s = 2.5;  ///< so often it is looked whether the frontier ahead is still one
  double stands_s = 30;       ///< a robot that holds on its way for so long has the mission fail
  double idle_s = 12;         ///< a robot that comes no further for so long, held by nothing, is blocked
  double thing_m = 0.8;       ///< size of what is in the way, of which one side is known only
  double meets_m = 0.6;       ///< what is so near ahead is put on the map before it stops the base
  int retries = 3;            ///< paths that end elsewhere before a frontier is given up
  int rounds = 2;             ///< so often what was left is tried again in the end without more being seen
  /// It goes back before the robot forgets what it stopped for: near things are remembered for 5 s.
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 1.5, .silent_s = 8, .limit_s = 3600};
  /// Who has many frontiers does not search for one for long. Among walls that are not known it does not
  /// turn: sonars hear what its sides face, and a corner swings into what they do not.
  RoutePlannerConfig route{.least_margin_m = 0.08,
                           .least_leeway_m = kLeastLeeway_m,
                           .costs = {.turn_m = 0.6, .sideways = 0},
                           .most_poses = 60000};
  ExplorationConfig choice;
  FloorGraphConfig graph;

  void Describe(Archive& a);
};

}  // namespace priamos::planner
