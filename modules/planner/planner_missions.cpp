#include "planner/planner_missions.hpp"

#include "lcmtypes/channels.hpp"
#include "planner/core/missions/corridor_mission.hpp"
#include "planner/core/missions/door_mission.hpp"
#include "planner/core/missions/explore_mission.hpp"
#include "planner/core/missions/goto_mission.hpp"
#include "planner/core/missions/locate_mission.hpp"

namespace priamos::planner {

MissionTable MakeMissions(const PlannerConfig& config, const GroundPlan& plan) {
  MissionTable missions;
  missions.Add(mission_command_t::PASS_DOOR,
               std::make_unique<DoorMission>(config.mission, config.passage, config.footprint, plan));
  missions.Add(mission_command_t::GOTO, std::make_unique<GotoMission>(config.go, config.footprint, plan));
  missions.Add(mission_command_t::CORRIDOR,
               std::make_unique<CorridorMission>(config.corridor, config.footprint, plan));
  missions.Add(mission_command_t::EXPLORE,
               std::make_unique<ExploreMission>(config.explore, config.footprint, plan));
  missions.Add(mission_command_t::LOCATE,
               std::make_unique<LocateMission>(config.locate, config.go.route, config.footprint, plan));
  return missions;
}

void Reconfigure(MissionTable& missions, const PlannerConfig& config) {
  if (auto* door = dynamic_cast<DoorMission*>(missions.Find(mission_command_t::PASS_DOOR)))
    door->set_config(config.mission);
  if (auto* go = dynamic_cast<GotoMission*>(missions.Find(mission_command_t::GOTO)))
    go->set_config(config.go);
  if (auto* corridor = dynamic_cast<CorridorMission*>(missions.Find(mission_command_t::CORRIDOR)))
    corridor->set_config(config.corridor);
  if (auto* explore = dynamic_cast<ExploreMission*>(missions.Find(mission_command_t::EXPLORE)))
    explore->set_config(config.explore);
}

std::optional<SeenFloor> SeenOf(MissionTable& missions) {
  auto* explore = dynamic_cast<ExploreMission*>(missions.Find(mission_command_t::EXPLORE));
  return explore ? explore->Seen() : std::nullopt;
}

AgendaSpeeds SpeedsOf(const PlannerConfig& config) {
  return {config.go.speed_m_s, config.mission.speed_m_s};
}

DoorRouter MakeRouter(const PlannerConfig& config, const GroundPlan& plan) {
  return {config.doors, config.go.route, config.passage, config.footprint, plan};
}

Agenda MakeAgenda(const PlannerConfig& config, MissionTable& missions, DoorRouter& router) {
  return {missions,
          router,
          {mission_command_t::GOTO, mission_command_t::PASS_DOOR, mission_command_t::CORRIDOR,
           mission_command_t::EXPLORE, mission_command_t::LOCATE},
          SpeedsOf(config),
          config.steps};
}

}  // namespace priamos::planner
