#pragma once

#include <optional>

#include "common/ground_plan.hpp"
#include "planner/core/agenda/agenda.hpp"
#include "planner/core/explore/seen_floor.hpp"
#include "planner/core/missions/mission_table.hpp"
#include "planner/planner_config.hpp"

namespace priamos::planner {

/// The missions that a planner knows, by the constants of mission_command_t.
using MissionMaker = MissionTable (*)(const PlannerConfig& config, const GroundPlan& plan);

/// Every mission that is shipped: one line each.
MissionTable MakeMissions(const PlannerConfig& config, const GroundPlan& plan);

/// Hands them the parameters that PlannerConfig marks as live.
void Reconfigure(MissionTable& missions, const PlannerConfig& config);
/// What the exploration has seen of the floor; nullopt: there was none.
std::optional<SeenFloor> SeenOf(MissionTable& missions);
/// With which the queue reckons.
AgendaSpeeds SpeedsOf(const PlannerConfig& config);

/// The ways through the doors of the plan.
DoorRouter MakeRouter(const PlannerConfig& config, const GroundPlan& plan);
/// The queue before the missions.
Agenda MakeAgenda(const PlannerConfig& config, MissionTable& missions, DoorRouter& router);

}  // namespace priamos::planner
