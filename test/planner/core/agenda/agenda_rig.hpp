#pragma once

#include <memory>

#include "planner/core/agenda/agenda.hpp"
#include "planner/core/missions/door_mission.hpp"
#include "planner/core/missions/goto_mission.hpp"
#include "test/planner/core/missions/fake_robot.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {

inline constexpr int kPass = 1, kGo = 2;

inline AgendaStep Go(double x, double y, double yaw = 0) {
  return {{kGo, 0, {{x, y, yaw}}}, {}};
}
inline AgendaStep Door(int id = 1) {
  return {{kPass, id, {}}, {}};
}
inline AgendaStep Stand(double seconds) {
  return {{}, seconds};
}

/// The queue before the missions through doors and to places, and the robot that they drive.
struct AgendaRig {
  explicit AgendaRig(const Pose2& truth = {2.0, 2.4, 0}, const GroundPlan& plan = ShippedPlan(),
                     const StepRunnerConfig& config = {})
      : router(DoorRouterConfig{}, RoutePlannerConfig{}, DoorPlannerConfig{}, Footprint{}, plan),
        dut(missions, router, {kGo, kPass}, {0.3, 0.3}, config),
        robot(missions, truth) {
    missions.Add(kPass,
                 std::make_unique<DoorMission>(DoorMissionConfig{}, DoorPlannerConfig{}, Footprint{}, plan));
    missions.Add(kGo, std::make_unique<GotoMission>(GotoMissionConfig{}, Footprint{}, plan));
    robot.tick = [this](Time now) { return dut.Tick(now); };
    robot.running = [this] { return dut.running(); };
    for (int i = 0; i < 20; ++i) robot.Step();  // it is heard before the first order
  }
  /// Gives an order. Returns its number.
  int Order(std::vector<AgendaStep> steps, int rounds = 1, int id = 0) {
    dut.Take({id, "", std::move(steps), rounds}, robot.now());
    return dut.waiting().empty() ? dut.order().id : dut.waiting().back().id;
  }
  void StepFor(double seconds) {
    for (const Time end = robot.now() + FromSeconds(seconds); robot.now() < end;) robot.Step();
  }
  void RunUntilStep(int step, double limit_s = 200) {
    for (const Time end = robot.now() + FromSeconds(limit_s); robot.now() < end && dut.step() != step;)
      robot.Step();
  }
  const AgendaResult& last() const { return dut.results().back(); }

  MissionTable missions;
  DoorRouter router;
  Agenda dut;
  FakeRobot robot;
};

}  // namespace priamos::planner
