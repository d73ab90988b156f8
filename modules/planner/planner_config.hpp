#pragma once

#include <string>

#include "common/archive.hpp"
#include "planner/core/agenda/step_runner.hpp"
#include "planner/core/map/learned_map.hpp"
#include "planner/core/missions/corridor_mission.hpp"
#include "planner/core/missions/door_mission.hpp"
#include "planner/core/missions/explore_mission.hpp"
#include "planner/core/missions/goto_mission.hpp"
#include "planner/core/missions/locate_mission.hpp"
#include "planner/core/path/door_planner.hpp"
#include "planner/core/path/door_router.hpp"
#include "planner/core/path/footprint.hpp"

namespace priamos::planner {

/// Contents of `config/<deployment>/planner.toml`.
struct PlannerConfig {
  std::string map = "maps/door.toml";  ///< ground plan, relative to the folder of this file
  std::string learned_map;             ///< file of what was learned; empty: forgotten when the planner ends
  double rate_hz = 20;                 ///< decisions
  double status_rate_hz = 2;           ///< MISSION_STATUS while nothing changes
  double model_period_s = 10;          ///< between two LANDMARK_MODELs, as in link.toml
  Footprint footprint;
  DoorPlannerConfig passage;
  DoorMissionConfig mission;
  GotoMissionConfig go;
  CorridorMissionConfig corridor;
  ExploreMissionConfig explore;
  LocateMissionConfig locate;
  LearnedMapConfig learned;
  DoorRouterConfig doors;
  StepRunnerConfig steps;

  void Describe(Archive& a);
};

}  // namespace priamos::planner
