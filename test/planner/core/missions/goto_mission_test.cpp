#include "planner/core/missions/goto_mission.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "fake_robot.hpp"
#include "test/planner/core/learned.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kGoto = 2;

/// The mission in its frame, and the robot that it drives.
struct Story {
  explicit Story(const Pose2& truth = {1.0, 2.4, 0}, const GroundPlan& plan = ShippedPlan())
      : robot(dut, truth) {
    dut.Add(kGoto, std::make_unique<GotoMission>(GotoMissionConfig{}, Footprint{}, plan));
  }
  void Start(const Goal& goal) { EXPECT_TRUE(dut.Start(robot.now(), {kGoto, 0, goal})); }
  /// Lets it drive until x, and puts something before it that goes away with the next path.
  void BlockAtX(double x_m) {
    robot.RunUntilX(x_m);
    robot.blocked = true;
    const std::size_t paths = robot.paths.size();
    for (int i = 0; i < 400 && dut.running() && robot.paths.size() == paths; ++i) robot.Step();
    robot.blocked = false;
  }

  MissionTable dut;
  FakeRobot robot;
};

TEST(GotoMissionTest, DrivesToTheGoal) {
  Story s;
  s.Start({{4.6, 1.3, kPi / 2}});
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone);
  EXPECT_THAT(s.dut.state().text, AllOf(StartsWith("at (4.60, 1.30) after"), HasSubstr("known to 0.01 m")));
  EXPECT_NEAR(s.robot.truth().x, 4.6, 0.01);
  EXPECT_NEAR(s.robot.truth().y, 1.3, 0.01);
  EXPECT_NEAR(s.robot.truth().yaw, kPi / 2, 0.01);
  EXPECT_EQ(s.robot.paths.size(), 1u);
}

TEST(GotoMissionTest, SaysWhereItGoesAndHowFarItIs) {
  Story s;
  s.Start({{4.0, 2.4, 0}});
  s.robot.RunUntil(Phase::kDriving, 5);
  EXPECT_EQ(s.dut.state().text, "driving to (4.00, 2.40), 3.0 m");
}

TEST(GotoMissionTest, ANoGoAreaIsDrivenAroundAndNoGoal) {
  GroundPlan plan = ShippedPlan();
  plan.no_go.push_back({"experiment", 3.0, 2.4, 0, 0.8, 0.8});
  Story around({1.0, 2.4, 0}, plan);
  around.Start({{4.9, 2.4, 0}});
  around.robot.RunFor(3);
  ASSERT_FALSE(around.robot.paths.empty()) << around.dut.state().text;
  EXPECT_GE(around.robot.paths[0].points.size(), 2u);
  Story into({1.0, 2.4, 0}, plan);
  into.Start({{3.0, 2.4, 0}});
  into.robot.RunFor(10);
  EXPECT_EQ(into.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(into.dut.state().text, HasSubstr("no-go area 'experiment'"));
}

TEST(GotoMissionTest, WithoutAHeadingAnyWillDo) {
  Story s({1.0, 2.4, 0.7});
  s.Start({{4.0, 1.0, 3.0}, false});
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_LT(std::abs(s.robot.truth().yaw), 1.5);
}

TEST(GotoMissionTest, ABoxOnTheWayIsPutOnTheMapAndAnotherWayIsDriven) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.BlockAtX(2.0);
  ASSERT_EQ(s.robot.paths.size(), 2u);
  EXPECT_THAT(s.dut.state().text, HasSubstr("the robot was blocked for 3 s: sonar; another way: driving to"));
  EXPECT_GE(s.robot.paths[1].points.size(), 3u) << "around it";
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(GotoMissionTest, WhereTheGoalIsTakenAPlaceThatDoesInsteadIsDrivenTo) {
  auto learned = std::make_shared<LearnedWalls>();
  learned->walls = {WallAt(4.2, 3.2, 0, 0.8)};  // 41 cm beside the goal
  for (const std::vector<Pose2>& instead : {std::vector<Pose2>{}, {{4.1, 2.4, 0}, {2.9, 2.4, 0}}}) {
    Story s;
    s.dut.OnLearned(learned);
    s.Start({{4.2, 2.76, 0}, true, instead});
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, instead.empty() ? Phase::kFailed : Phase::kDone) << s.dut.state().text;
    if (!instead.empty()) {
      EXPECT_NEAR(s.robot.truth().x, 4.1, 0.01) << "the first that is free";
    }
  }
}

TEST(GotoMissionTest, ARobotThatHoldsForGoodEndsItWithTheReason) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.lost = true;
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kDriving) << "it may find itself again";
  EXPECT_THAT(s.dut.state().text,
              AllOf(StartsWith("driving to (5.00, 2.40)"), HasSubstr("; the robot holds: the pose")));
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text,
              StartsWith("the robot has held on its way for 30 s: the pose is too uncertain or too old"));
}

TEST(GotoMissionTest, WhatHoldsTheRobotIsSaidAsLongAsItDoes) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.lost = true;
  s.robot.RunFor(5);
  EXPECT_THAT(s.dut.state().text, HasSubstr("the robot holds"));
  s.robot.lost = false;
  s.robot.RunFor(2);
  EXPECT_THAT(s.dut.state().text, testing::Not(HasSubstr("the robot holds")));
}

TEST(GotoMissionTest, AWallThatTurnsUpAcrossThePathIsDrivenAround) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(1.5);
  auto learned = std::make_shared<LearnedWalls>();
  learned->walls = {WallAt(3, 0.06, 0, 3)};
  s.dut.OnLearned(learned);
  s.robot.RunFor(1);
  EXPECT_EQ(s.robot.paths.size(), 1u) << "a wall that is on the plan changes nothing";
  learned = std::make_shared<LearnedWalls>(*learned);
  learned->walls.push_back(WallAt(3.2, 2.4, 90, 1.2));
  s.dut.OnLearned(learned);
  s.robot.RunFor(1);
  ASSERT_EQ(s.robot.paths.size(), 2u);
  EXPECT_THAT(s.dut.state().text, StartsWith("in the way: learned wall 1; another way: driving"));
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_EQ(s.robot.paths.size(), 2u) << "the same walls again are no news";
}

TEST(GotoMissionTest, AThingThatTheHeadSawAcrossThePathIsDrivenAround) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(1.5);
  auto learned = std::make_shared<LearnedWalls>();
  learned->objects = {BoxAt(3.2, 2.4, 0)};
  learned->objects[0].looks = 1;
  s.dut.OnLearned(learned);
  s.robot.RunFor(1);
  EXPECT_EQ(s.robot.paths.size(), 1u) << "one look is not enough";
  learned = std::make_shared<LearnedWalls>(*learned);
  learned->objects[0].looks = 2;
  s.dut.OnLearned(learned);
  s.robot.RunFor(1);
  ASSERT_EQ(s.robot.paths.size(), 2u);
  EXPECT_THAT(s.dut.state().text, StartsWith("in the way: thing 3, 0.60 x 0.40 m, seen by the head; another "
                                             "way: driving"));
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_EQ(s.robot.paths.size(), 2u);
}

TEST(GotoMissionTest, AWallThatLeavesNoWayEndsNothing) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(1.5);
  auto learned = std::make_shared<LearnedWalls>();
  learned->walls = {WallAt(3.2, 2.4, 90, 4.7)};
  s.dut.OnLearned(learned);
  s.robot.RunFor(2);
  EXPECT_EQ(s.dut.state().phase, Phase::kDriving) << "the map may be wrong; the robot stops itself";
  EXPECT_EQ(s.robot.paths.size(), 1u);
}

TEST(GotoMissionTest, WhoIsStoppedAtTheGoalIsThere) {
  Story s;
  s.Start({{3.0, 2.4, 0}});
  s.robot.RunUntilX(2.93);
  s.robot.blocked = true;
  s.robot.RunFor(10);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  for (int i = 0; i < 10; ++i) s.robot.Step();  // the radio's delay
  EXPECT_TRUE(s.robot.paths.back().points.empty()) << "it does not go on when the way is free again";
}

TEST(GotoMissionTest, ANewMissionForgetsWhatStopped) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.BlockAtX(2.0);
  s.robot.RunFor(60);
  s.Start({{2.0, 2.4, 0}});
  s.robot.RunFor(60);
  EXPECT_EQ(s.robot.paths.back().points.size(), 2u);
}

TEST(GotoMissionTest, AfterThreeOtherWaysItGivesUp) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.blocked = true;
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  for (int i = 0; i < 10; ++i) s.robot.Step();  // the radio's delay
  EXPECT_TRUE(s.robot.paths.back().points.empty()) << "it brakes";
}

TEST(GotoMissionTest, WhoStandsAtTheGoalIsWaitedFor) {
  Story s;
  s.Start({{2.6, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.blocked = true;
  s.robot.RunUntil(Phase::kWaiting, 6);
  EXPECT_THAT(s.dut.state().text,
              AllOf(StartsWith("the robot was blocked for 3 s: sonar, and at (2.60, 2.40)"),
                    HasSubstr("waits 8 s for it to go away, 1 of 3 times")));
  s.robot.RunFor(1);
  EXPECT_TRUE(s.robot.paths.back().points.empty()) << "it stands";
  s.robot.blocked = false;
  s.robot.RunFor(6);
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting);
  s.robot.RunFor(10);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(GotoMissionTest, WhatNeverGoesAwayFromTheGoalEndsItAfterThreeWaits) {
  Story s;
  s.Start({{2.6, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.blocked = true;
  s.robot.RunFor(35);
  EXPECT_TRUE(s.dut.running());
  s.robot.RunFor(15);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("blocked for 3 s: sonar, and at (2.60, 2.40)"));
}

TEST(GotoMissionTest, ARobotThatComesNoFurtherThoughNothingHoldsItLooksForAnotherWay) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.idle = true;
  s.robot.RunFor(11);
  EXPECT_EQ(s.robot.paths.size(), 1u);
  s.robot.RunFor(3);
  ASSERT_EQ(s.robot.paths.size(), 2u);
  EXPECT_THAT(s.dut.state().text, StartsWith("the robot came no further; another way: driving to"));
  s.robot.idle = false;
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(GotoMissionTest, ARobotThatTurnsSlowlyOnTheSpotGetsOn) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.idle = true;
  for (int i = 0; i < 40; ++i) {
    s.robot.error.yaw += 0.05 * 0.5;
    s.robot.RunFor(0.5);
  }
  EXPECT_EQ(s.robot.paths.size(), 1u) << s.dut.state().text;
}

TEST(GotoMissionTest, ATouchEndsIt) {
  Story s;
  s.Start({{5.0, 2.4, 0}});
  s.robot.RunUntilX(2.0);
  s.robot.touched = true;
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("touched something; next: look what it is"));
}

TEST(GotoMissionTest, AGoalInAWallIsRefusedAndNothingMoves) {
  Story s;
  s.Start({{4.0, 0.2, 0}});
  s.robot.RunFor(10);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("wall 'south'"));
  EXPECT_EQ(s.robot.truth().x, 1.0);
}

TEST(GotoMissionTest, AGoalThatIsNoNumberIsRefused) {
  Story s;
  s.Start({{std::numeric_limits<double>::quiet_NaN(), 0.2, 0}});
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
}

TEST(GotoMissionTest, ALongWayIsDrivenInPieces) {
  GroundPlan plan;
  for (int i = 0; i < 20; ++i) {  // a zigzag between screens, 2 m apart
    const double x = 2.0 * i + 2, low = i % 2 == 0 ? 0 : 1.6;
    plan.walls.push_back({"screen", {x, low}, {x, low + 2.4}, 0.1});
  }
  plan.walls.push_back({"south", {-1, -0.05}, {44, -0.05}, 0.1});
  plan.walls.push_back({"north", {-1, 4.05}, {44, 4.05}, 0.1});
  plan.walls.push_back({"west", {-1, -0.05}, {-1, 4.05}, 0.1});
  plan.walls.push_back({"east", {44, -0.05}, {44, 4.05}, 0.1});
  Story s({1, 2, 0}, plan);
  s.Start({{41, 2, 0}});
  s.robot.RunFor(590);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_GE(s.robot.paths.size(), 2u);
  for (const PathOrder& path : s.robot.paths) EXPECT_LE(path.points.size(), 16u);
}

TEST(GotoMissionTest, WhatStandsAtTheGoalLetsTheBaseComeBesideIt) {
  Story s;
  s.Start({{4.6, 2.4, 0}, false});
  s.robot.RunUntilX(4.4);
  s.robot.blocked = true;
  s.robot.RunFor(120);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone);
  EXPECT_THAT(s.dut.state().text, AllOf(HasSubstr("m beside (4.60, 2.40): "), HasSubstr("blocked")));
  for (int i = 0; i < 10; ++i) s.robot.Step();  // the radio's delay
  EXPECT_TRUE(s.robot.paths.back().points.empty()) << "nothing is left to be driven";
}

TEST(GotoMissionTest, AGoalThatAThingOfTheMapTakesIsReachedBesideIt) {
  Story s({4.4, 2.4, 0});
  auto learned = std::make_shared<LearnedWalls>();
  learned->objects = {BoxAt(5.05, 2.4, 0)};
  learned->objects[0].looks = 3;
  s.dut.OnLearned(learned);
  s.Start({{4.6, 2.4, 0}});
  s.robot.RunFor(5);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone);
  EXPECT_THAT(s.dut.state().text, AllOf(HasSubstr("m beside (4.60, 2.40): "), HasSubstr("seen by the head")));
}

TEST(GotoMissionTest, WhatStoppedItMayBeSmallerThanItWasTakenFor) {
  Story s;
  s.Start({{4.6, 2.4, 0}});
  s.robot.RunUntilX(3.1);
  s.robot.blocked = true;
  s.robot.RunFor(5);
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting) << "half a metre of it would reach to the goal";
  s.robot.RunFor(13);
  EXPECT_EQ(s.dut.state().phase, Phase::kDriving);
  EXPECT_THAT(s.dut.state().text, HasSubstr("another way: driving to (4.60, 2.40)"));
  s.robot.blocked = false;
  s.robot.RunFor(40);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(GotoMissionTest, FartherFromTheGoalItFails) {
  Story s;
  s.Start({{4.6, 2.4, 0}, false});
  s.robot.RunUntilX(4.2);
  s.robot.blocked = true;
  s.robot.RunFor(200);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
}

}  // namespace
}  // namespace priamos::planner
