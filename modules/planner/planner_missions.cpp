#include "planner/planner_missions.hpp"

#include "lcmtypes/channels.hpp"
#include "planner/core/missions/corridor_mission.hpp"
#include "planner/core/missions/door_mission.hpp"
#include "planner/core/missions/goto_mission.hpp"

namespace priamos::planner {

MissionTable MakeMissions(const PlannerConfig& config, const GroundPlan& plan) {
  MissionTable missions;
  missions.Add(mission_command_t::PASS_DOOR,
               std::make_unique<DoorMission>(config.mission, config.passage, config.footprint, plan));
  missions.Add(mission_command_t::GOTO, std::make_unique<GotoMission>(config.go, config.footprint, plan));
  missions.Add(mission_command_t::CORRIDOR,
               std::make_unique<CorridorMission>(config.corridor, config.footprint, plan));
  return missions;
}

DoorRouter MakeRouter(const PlannerConfig& config, const GroundPlan& plan) {
  return {config.doors, config.go.route, config.passage, config.footprint, plan};
}

Agenda MakeAgenda(const PlannerConfig& config, MissionTable& missions, DoorRouter& router) {
  return {missions,
          router,
          {mission_command_t::GOTO, mission_command_t::PASS_DOOR, mission_command_t::CORRIDOR},
          {config.go.speed_m_s, config.mission.speed_m_s},
          config.steps};
}

}  // namespace priamos::planner
