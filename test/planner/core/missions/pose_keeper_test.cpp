#include "planner/core/missions/pose_keeper.hpp"

#include <gtest/gtest.h>

#include "fake_robot.hpp"
#include "planner/core/missions/goto_mission.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

const DoorPlan* InSight(const Pose2& map_from_base) {
  static const GroundPlan plan = ShippedPlan();
  static const PoseKeeper dut({}, plan);
  return dut.DoorInSight(map_from_base);
}

TEST(PoseKeeperTest, ADoorIsInSightFromItsFrontAtTheRightDistance) {
  EXPECT_TRUE(InSight({3.5, 2.4, 0}));
  EXPECT_EQ(InSight({3.5, 2.4, 0})->name, "laboratory");
  EXPECT_TRUE(InSight({3.5, 3.5, 0}));
  EXPECT_FALSE(InSight({2.4, 2.4, 0})) << "too far";
  EXPECT_FALSE(InSight({5.0, 2.4, 0})) << "too near";
  EXPECT_TRUE(InSight({5.0, 4.2, 0})) << "at a slant, as all doors of a corridor are";
  EXPECT_FALSE(InSight({5.4, 4.2, 0})) << "hardly anything of it can be seen";
  ASSERT_TRUE(InSight({8.5, 2.4, kPi})) << "from behind it is another landmark";
  EXPECT_EQ(InSight({8.5, 2.4, kPi})->id, ShippedPlan().doors[0].behind_id);
}

TEST(PoseKeeperTest, TheHeadTurnsSoFarAndNoFarther) {
  EXPECT_TRUE(InSight({3.5, 2.4, kPi / 2}));
  EXPECT_FALSE(InSight({3.5, 2.4, Radians(120)}));
}

GroundPlan WithoutDoors() {
  GroundPlan plan = ShippedPlan();
  plan.doors.clear();
  return plan;
}

/// A drive from (0.8, 2.4) to (4.6, 2.4) with a pose known to `sigma_m`.
struct Drive {
  explicit Drive(double sigma_m, const GroundPlan& plan = ShippedPlan()) : robot(missions, {0.8, 2.4, 0}) {
    missions.Add(2, std::make_unique<GotoMission>(GotoMissionConfig{}, Footprint{}, plan));
    robot.sigma_m = sigma_m;
    missions.Start(robot.now(), {2, 0, {{4.6, 2.4, 0}}});
  }
  MissionTable missions;
  FakeRobot robot;
};

TEST(PoseKeeperTest, AnUncertainPoseIsCorrectedOnTheWay) {
  Drive drive(0.12);
  drive.robot.error = {0.05, -0.1, 0};
  drive.robot.RunFor(60);
  EXPECT_EQ(drive.missions.state().phase, Phase::kDone) << drive.missions.state().text;
  EXPECT_GE(drive.robot.looks.size(), 2u);
  EXPECT_LE(drive.robot.looks.size(), 3u) << "after them it is known well";
  EXPECT_GT(drive.robot.look_speed_m_s.back(), 0.2) << "it does not stand for them";
  EXPECT_NEAR(drive.robot.truth().y, 2.4, 0.02);
}

TEST(PoseKeeperTest, AKnownPoseIsLeftAlone) {
  Drive drive(0.05);
  drive.robot.RunFor(60);
  EXPECT_TRUE(drive.robot.looks.empty());
}

/// The walls of the plan that the robot was given last on half a minute of a drive.
std::vector<WallFace> WallsGiven(Drive& drive) {
  std::vector<WallFace> faces;
  drive.robot.tick = [&](Time now) {
    MissionActions actions = drive.missions.Tick(now);
    if (actions.faces) faces = *actions.faces;
    return actions;
  };
  drive.robot.RunFor(30);
  return faces;
}

TEST(PoseKeeperTest, WhereNoDoorIsInSightWallsOfThePlanHelp) {
  Drive uncertain(0.12, WithoutDoors());
  EXPECT_FALSE(WallsGiven(uncertain).empty());
  Drive known(0.05, WithoutDoors());
  EXPECT_TRUE(WallsGiven(known).empty());
}

TEST(PoseKeeperTest, TheHeadGetsTheModelBeforeItLooks) {
  Drive drive(0.12);
  drive.robot.answer = [&](const LookOrder& look, int) {
    EXPECT_EQ(drive.robot.models_received, 1);
    return LookResult{look.request_id, true, "", false};
  };
  drive.robot.RunFor(60);
  EXPECT_GE(drive.robot.looks.size(), 2u);
  EXPECT_EQ(drive.robot.models_received, 1);
}

TEST(PoseKeeperTest, AHeadThatHasLostTheModelGetsItOnceMore) {
  Drive drive(0.12);
  drive.robot.answer = [&](const LookOrder& look, int n) {
    return LookResult{look.request_id, n > 0, "the head has no model of it", n == 0};
  };
  drive.robot.RunFor(60);
  EXPECT_EQ(drive.robot.models_received, 2);
  EXPECT_GE(drive.robot.looks.size(), 2u);
}

TEST(PoseKeeperTest, LooksThatFailEndAfterAWhileAndTheDriveGoesOn) {
  Drive drive(0.12);
  drive.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "not visible from there", false};
  };
  drive.robot.RunFor(60);
  EXPECT_EQ(drive.missions.state().phase, Phase::kDone) << drive.missions.state().text;
  EXPECT_LE(drive.robot.looks.size(), 9u);
}

}  // namespace
}  // namespace priamos::planner
