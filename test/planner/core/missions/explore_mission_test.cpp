#include "planner/core/missions/explore_mission.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fake_robot.hpp"
#include "test/planner/core/explore/ideal_floor.hpp"

namespace priamos::planner {
namespace {

using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr int kExplore = 4;

/// A base that drives where it is led on an L of 5 squares of 2 m, and is told the walls that it passes.
struct Story {
  explicit Story(const ExploreMissionConfig& config = {}) : robot(dut, floor.base()) {
    dut.Add(kExplore, std::make_unique<ExploreMission>(config, Footprint{}, GroundPlan{}));
    robot.sigma_m = 0.01;
    robot.tick = [this](Time now) {
      floor.HearFrom(robot.truth().translation());
      inside = inside && floor.Holds(robot.truth().translation());
      const auto& walls = floor.told().walls;
      for (; dut.heard().pose && told < walls.size(); ++told) Tell(walls[told], now);
      return dut.Tick(now);
    };
  }
  /// In the robot's own frame, which is off when `robot.error` says so.
  void Tell(LearnedWall wall, Time now) {
    const Pose2 at = robot.Believed() * robot.truth().Inverse() * wall.map_from_wall();
    wall.x_m = at.x;
    wall.y_m = at.y;
    wall.yaw_deg = Degrees(at.yaw);
    wall.seen_s = 1e-6 * static_cast<double>(ToUtime(now));
    dut.OnTold({1, wall.id, wall});
  }
  void Run(double seconds) {
    ASSERT_TRUE(dut.Start(robot.now(), {kExplore}));
    robot.RunFor(seconds);
  }

  IdealFloor floor{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}};
  MissionTable dut;
  FakeRobot robot;
  std::size_t told = 0;
  bool inside = true;
};

TEST(ExploreMissionTest, TheFloorIsExploredAndTheRobotStands) {
  Story s;
  s.Run(200);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("explored "));
  EXPECT_TRUE(s.inside);
  ASSERT_THAT(s.robot.paths, Not(IsEmpty()));
  EXPECT_GT(s.robot.truth().y, 2) << "it was round the corner";
  s.robot.Step();
  for (int i = 0; i < 20; ++i) s.robot.Step();
  EXPECT_THAT(s.robot.paths.back().points, IsEmpty()) << "what is left of the path is not driven";
}

/// A line without leeway tells the robot that it is planned to the centimetre: no map is as good that is just
/// being made.
TEST(ExploreMissionTest, EachLineMayBeLeft) {
  Story s;
  s.Run(60);
  ASSERT_THAT(s.robot.paths, Not(IsEmpty()));
  for (const PathOrder& path : s.robot.paths) {
    ASSERT_THAT(path.leeway, SizeIs(path.points.size()));
    for (const Leeway& leeway : path.leeway) EXPECT_GE(std::min(leeway.left_m, leeway.right_m), 0.1);
  }
}

TEST(ExploreMissionTest, BeforeThePoseIsKnownNothingIsSent) {
  Story s;
  s.robot.silent = true;
  s.Run(4);
  EXPECT_THAT(s.robot.paths, IsEmpty());
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting);
}

TEST(ExploreMissionTest, ARobotThatGetsNowhereFailsWithTheFrontiersThatAreLeft) {
  Story s;
  s.robot.blocked = true;
  s.Run(300);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("the base has not moved"));
  EXPECT_THAT(s.dut.state().text, HasSubstr("frontiers left"));
}

TEST(ExploreMissionTest, WhoIsShutInByTheMapHasExploredNothing) {
  Story s;
  auto learned = std::make_shared<LearnedWalls>();
  constexpr int kPoints = 30;  // nearer ones would be one
  for (int i = 0; i < kPoints; ++i) {
    const double turned = 2 * kPi * i / kPoints;
    const Eigen::Vector2d at = s.robot.truth().translation() + Pose2{0, 0, turned} * Eigen::Vector2d(1.2, 0);
    learned->points.push_back({at.x(), at.y(), 0.02, 1000, i + 1});
  }
  s.dut.OnLearned(learned);
  s.Run(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, StartsWith("the base has not moved: nothing more is reached"));
}

TEST(ExploreMissionTest, WhoCannotMoveAnyMoreSaysWhatIsLeft) {
  Story s;
  s.Run(8);
  s.robot.blocked = true;
  s.robot.RunFor(400);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, HasSubstr("frontiers left"));
}

TEST(ExploreMissionTest, WhoTouchedSomethingAsksAPerson) {
  ExploreMissionConfig config;
  config.reconsider_s = 60;  // a path on its way is another motion than the one that touched
  Story s(config);
  s.Run(3);
  s.robot.touched = true;
  s.robot.RunFor(5);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("touched"));
}

TEST(ExploreMissionTest, WhoIsStoppedGoesBackOnItsWayAndTheSecondTimeFarther) {
  Story s;
  s.Run(10);
  s.robot.blocked = true;
  const double stopped_m = s.robot.truth().x;
  std::vector<double> back_m;  // where the ways back lead
  std::string last;
  for (int i = 0; i < 800; ++i) {
    s.robot.Step();
    if (const std::string& text = s.dut.state().text; text != last) {
      last = text;
      s.robot.RunFor(0.5);
      const auto& path = s.robot.paths.back().points;
      if (text.find("going back") != std::string::npos && !path.empty())
        back_m.push_back(stopped_m - path.back().x);
    }
  }
  ASSERT_THAT(back_m, SizeIs(Ge(2U)));
  EXPECT_NEAR(back_m[0], 0.55, 0.2) << "it does not turn where it was stopped";
  EXPECT_GT(back_m[1], 0.9);
}

TEST(ExploreMissionTest, AHoldIsNotWaitedForForEver) {
  ExploreMissionConfig config;
  config.stands_s = 12;
  Story s(config);
  s.Run(3);
  s.robot.lost = true;
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text,
              HasSubstr("has held on its way for 12 s: the pose is too uncertain or too old"));
}

TEST(ExploreMissionTest, WhoStandsBeforeAnEchoIsBlocked) {
  Story s;
  s.Run(3);
  s.robot.by_echo = true;
  s.robot.RunFor(14);
  EXPECT_EQ(s.dut.state().phase, Phase::kDriving) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, HasSubstr("going back a bit"));
}

TEST(ExploreMissionTest, WhatTheHeadSawIsDrivenAround) {
  Story s;
  auto learned = std::make_shared<LearnedWalls>();
  learned->objects = {BoxAt(2.5, 0.75, -90)};  // from the wall into the way along the middle
  learned->objects[0].depth_m = 0.7;
  s.dut.OnLearned(learned);
  const Rectangle box = learned->objects[0].Footprint();
  double least_m = 9;
  ASSERT_TRUE(s.dut.Start(s.robot.now(), {kExplore}));
  for (int i = 0; i < 1000 && s.robot.truth().x < 4; ++i) {
    s.robot.Step();
    least_m = std::min(least_m, Distance(Footprint{}.At(s.robot.truth()), box));
  }
  EXPECT_GE(s.robot.truth().x, 4) << s.dut.state().text;
  EXPECT_GT(least_m, 0.05);
}

TEST(ExploreMissionTest, ASecondOrderBeginsAnew) {
  Story s;
  s.Run(200);
  const std::size_t before = s.robot.paths.size();
  s.dut.OnLearned(std::make_shared<LearnedWalls>(s.floor.told()));  // what the planner has kept
  s.Run(100);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_GT(s.robot.paths.size(), before + 2);
}

}  // namespace
}  // namespace priamos::planner
