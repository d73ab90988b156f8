#include "planner/core/missions/corridor_mission.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "fake_robot.hpp"

namespace priamos::planner {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr int kCorridor = 3;

WallPlan Wall(double x1, double y1, double x2, double y2) {
  WallPlan wall;
  wall.from_m = {x1, y1};
  wall.to_m = {x2, y2};
  return wall;
}

/// Along x, between y = -1 and 1, from 0 to 20.
GroundPlan Corridor() {
  GroundPlan plan;
  plan.walls = {Wall(0, -1.07, 20, -1.07), Wall(0, 1.07, 20, 1.07), Wall(20.07, -1, 20.07, 1)};
  return plan;
}

struct Story {
  explicit Story(const GroundPlan& plan = Corridor(), const Pose2& truth = {1, 0, 0.1}) : robot(dut, truth) {
    dut.Add(kCorridor, std::make_unique<CorridorMission>(CorridorMissionConfig{}, Footprint{}, plan));
    robot.tick = [this](Time now) {
      MissionActions actions = dut.Tick(now);
      if (actions.faces) faces = *actions.faces;
      return actions;
    };
  }
  void Start(double distance_m, std::optional<double> yaw = std::nullopt) {
    EXPECT_TRUE(
        dut.Start(robot.now(), {kCorridor, 0, {{0, 0, yaw.value_or(0)}, yaw.has_value()}, distance_m}));
  }

  MissionTable dut;
  FakeRobot robot;
  std::optional<std::vector<WallFace>> faces;
};

TEST(CorridorMissionTest, OneCentredPathLeadsAsFarAsOrdered) {
  Story s;
  s.Start(6);
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("followed the corridor for 6.0 m in "));
  ASSERT_THAT(s.robot.paths, SizeIs(1));
  EXPECT_TRUE(s.robot.paths[0].centre);
  ASSERT_THAT(s.robot.paths[0].points, SizeIs(1));
  EXPECT_NEAR(s.robot.paths[0].points[0].yaw, 0, 1e-9)
      << "along the walls of the plan, not as the base stands";
  EXPECT_NEAR(s.robot.truth().x, 7, 0.01);
}

TEST(CorridorMissionTest, TheRobotIsToldTheWallsAlongTheWay) {
  Story s;
  s.Start(6);
  s.robot.RunFor(1);
  ASSERT_TRUE(s.faces);
  EXPECT_THAT(*s.faces, SizeIs(2));
  s.robot.RunFor(60);
  s.faces.reset();
  s.Start(2);
  s.robot.RunFor(1);
  EXPECT_FALSE(s.faces) << "it has them";
}

TEST(CorridorMissionTest, WithoutAPlanTheBaseLeadsTheWayItStands) {
  Story s(GroundPlan{});
  s.Start(4);
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_NEAR(s.robot.truth().yaw, 0.1, 0.001);
  EXPECT_NEAR(s.robot.truth().y, 4 * std::sin(0.1), 0.01);
  EXPECT_FALSE(s.faces);
}

TEST(CorridorMissionTest, ADirectionCanBeOrdered) {
  Story s;
  s.Start(5, kPi);
  s.robot.RunFor(1);
  ASSERT_THAT(s.robot.paths, SizeIs(1));
  EXPECT_NEAR(s.robot.paths[0].points[0].x, -4, 1e-6);
}

TEST(CorridorMissionTest, WhereNothingLeavesRoomIsTheEnd) {
  Story s;
  s.Start(0);
  s.robot.RunUntilX(19.3, 100);
  s.robot.blocked = true;
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("at the end of the corridor after 18.3 m in "));
  for (int i = 0; i < 10; ++i) s.robot.Step();
  EXPECT_THAT(s.robot.paths.back().points, SizeIs(0)) << "what is left is not to be driven later";
}

TEST(CorridorMissionTest, WhereItsWallsEndIsTheEnd) {
  GroundPlan hall;
  hall.walls = {Wall(0, -1.07, 12, -1.07), Wall(0, 1.07, 10, 1.07), Wall(40, -20, 40, 20)};
  Story s(hall);
  s.Start(0);
  s.robot.RunFor(200);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("where the corridor opens after "));
  const CorridorMissionConfig config;
  EXPECT_NEAR(s.robot.truth().x, 12 + std::sqrt(9 - 1.07 * 1.07) + config.open_m, 0.5);
}

TEST(CorridorMissionTest, AJunctionIsNoEnd) {
  GroundPlan junction;
  for (const double side : {-1.07, 1.07}) {
    junction.walls.push_back(Wall(0, side, 8, side));
    junction.walls.push_back(Wall(14, side, 25, side));
  }
  Story s(junction);
  s.Start(0);
  s.robot.RunUntilX(22, 200);
  EXPECT_EQ(s.dut.state().phase, Phase::kDriving) << s.dut.state().text;
}

TEST(CorridorMissionTest, WhereNoWallIsNoCorridorIs) {
  Story s(GroundPlan{});
  s.Start(0);
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, StartsWith("no corridor: no wall was found beside the robot in 6."));
}

TEST(CorridorMissionTest, ClosedBeforeItsEndOnThePlanItHasFailed) {
  Story s;
  s.Start(0);
  s.robot.RunUntilX(9, 100);
  s.robot.blocked = true;
  s.robot.RunFor(100);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(
      s.dut.state().text,
      StartsWith("the corridor is closed after 8.0 m, on the plan it ends after 18.5 m: the robot was "
                 "blocked for"));
}

TEST(CorridorMissionTest, ClosedBeforeTheDistanceOrderedItHasFailed) {
  Story s(GroundPlan{});
  s.Start(10);
  s.robot.RunUntilX(4, 100);
  s.robot.blocked = true;
  s.robot.RunFor(100);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text,
              AllOf(StartsWith("the corridor is closed after 3.0 of 10.0 m"), HasSubstr("blocked")));
}

TEST(CorridorMissionTest, WhoeverClosesItMayLeave) {
  Story s;
  s.Start(0);
  s.robot.RunUntilX(9, 100);
  s.robot.blocked = true;
  s.robot.RunFor(30);
  EXPECT_TRUE(s.dut.running());
  s.robot.blocked = false;
  s.robot.RunUntilX(19.3, 200);
  s.robot.blocked = true;
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("at the end of the corridor after 18.3 m in "));
}

TEST(CorridorMissionTest, WhatClosesItIsHeardAnewFromFartherBack) {
  Story s;
  s.Start(0);
  s.robot.RunUntilX(9, 100);
  s.robot.blocked = true;
  s.robot.RunFor(9);
  ASSERT_THAT(s.robot.paths, SizeIs(2));
  EXPECT_FALSE(s.robot.paths[1].centre);
  EXPECT_NEAR(s.robot.paths[1].points[0].x, 8.5, 0.1);
  s.robot.blocked = false;
  s.robot.RunUntilX(9.5, 100);
  ASSERT_THAT(s.robot.paths, SizeIs(3));
  EXPECT_TRUE(s.robot.paths[2].centre);
  EXPECT_NEAR(s.robot.paths[2].points[0].x - 8.5, s.robot.paths[0].points[0].x - 9, 0.2)
      << "what was left of the way";
}

TEST(CorridorMissionTest, WhoDrivesThroughTheEndOfThePlanByItsWheelsIsNotBelieved) {
  Story s;
  s.Start(0);
  s.robot.RunFor(400);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("do they turn while the base stands? next: "));
}

TEST(CorridorMissionTest, ATouchEndsIt) {
  Story s;
  s.Start(0);
  s.robot.RunUntilX(4, 100);
  s.robot.touched = true;
  s.robot.RunFor(5);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "the robot touched something; next: look what it is, and order it again");
}

TEST(CorridorMissionTest, ABlackoutIsDrivenThroughWithoutANewOrder) {
  Story s;
  s.dut.TolerateSilence(300);
  s.Start(8);
  s.robot.RunUntilX(3, 100);
  s.robot.silent = true;
  s.robot.RunFor(12);
  EXPECT_TRUE(s.dut.running());
  s.robot.silent = false;
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.robot.paths, SizeIs(1));
}

TEST(CorridorMissionTest, APausedOneGoesOnCentred) {
  Story s;
  s.Start(8);
  s.robot.RunUntilX(3, 100);
  s.dut.Pause(s.robot.now());
  s.robot.RunFor(3);
  s.dut.Resume(s.robot.now());
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_TRUE(s.robot.paths.back().centre);
  EXPECT_NEAR(s.robot.truth().x, 9, 0.05);
}

TEST(CorridorMissionTest, ADistanceThatIsNoneIsRefused) {
  for (const double distance_m : {-1.0, 181.0, std::numeric_limits<double>::quiet_NaN()}) {
    Story s;
    s.Start(distance_m);
    s.robot.RunFor(1);
    EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
    EXPECT_EQ(s.dut.state().text, "a corridor is followed for 0 (to its end) to 180 m");
  }
}

}  // namespace
}  // namespace priamos::planner
