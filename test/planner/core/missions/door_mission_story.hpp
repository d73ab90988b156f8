#pragma once

#include <memory>

#include "fake_robot.hpp"
#include "planner/core/missions/door_mission.hpp"
#include "planner/core/missions/mission_table.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {

constexpr int kPassDoor = 1;  ///< its number in a MissionTable

/// The door mission in its frame, and the robot that it drives.
struct DoorStory {
  explicit DoorStory(const Pose2& truth = {2.0, 2.4, 0}, const GroundPlan& plan = ShippedPlan(),
                     const DoorMissionConfig& config = {})
      : robot(dut, truth) {
    dut.Add(kPassDoor, std::make_unique<DoorMission>(config, DoorPlannerConfig{}, Footprint{}, plan));
  }
  void Start() { EXPECT_TRUE(dut.Start(robot.now(), {kPassDoor, 1})); }

  MissionTable dut;
  FakeRobot robot;
};

}  // namespace priamos::planner
