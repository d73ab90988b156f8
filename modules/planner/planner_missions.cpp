#include "planner/planner_missions.hpp"

#include "lcmtypes/channels.hpp"
#include "planner/core/missions/door_mission.hpp"
#include "planner/core/missions/goto_mission.hpp"

namespace priamos::planner {

MissionTable MakeMissions(const PlannerConfig& config, const GroundPlan& plan) {
  MissionTable missions;
  missions.Add(mission_command_t::PASS_DOOR,
               std::make_unique<DoorMission>(config.mission, config.passage, config.footprint, plan));
  missions.Add(mission_command_t::GOTO, std::make_unique<GotoMission>(config.go, config.footprint, plan));
  return missions;
}

}  // namespace priamos::planner
