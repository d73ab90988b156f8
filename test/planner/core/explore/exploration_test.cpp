#include "planner/core/explore/exploration.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "ideal_floor.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kWidth_m = 0.98;

/// Explores it; returns after how many frontiers it ended, or `most`.
int Explore(Exploration& dut, IdealFloor& floor, int most = 400) {
  dut.NoteAt(floor.base());
  for (int n = 0; n < most; ++n) {
    dut.Learn(floor.told());
    const auto goal = dut.Choose(floor.base());
    if (!goal) return n;
    const bool there = floor.Drive(goal->goal, dut);
    dut.Learn(floor.told());
    if (!dut.IsOpen(*goal)) continue;
    if (there) {
      dut.GiveUp(goal->target, "seen from near by");
    } else {
      const Eigen::Vector2d off = goal->goal - floor.base().translation(),
                            at = floor.base().translation() + 0.75 * off.normalized();
      dut.AddThing({{at.x(), at.y(), std::atan2(off.y(), off.x())}, {0.25, 0.25}});
      if (n % 4 == 3) dut.GiveUp(goal->target, "blocked");
    }
  }
  return most;
}

TEST(ExplorationTest, AtFirstItLeadsAhead) {
  for (const double yaw : {0.0, 1.5, -2.5}) {
    Exploration dut({}, kWidth_m, {});
    dut.NoteAt({3, 4, yaw});
    const auto goal = dut.Choose({3, 4, yaw});
    ASSERT_TRUE(goal);
    const Eigen::Vector2d there = Pose2{3, 4, yaw}.Inverse() * goal->target;
    EXPECT_NEAR(std::atan2(there.y(), there.x()), 0, 0.15);
    EXPECT_GT((goal->goal - Eigen::Vector2d(3, 4)).norm(), 2);
    EXPECT_TRUE(dut.IsOpen(*goal));
  }
}

TEST(ExplorationTest, OneRoomIsSeenAndThenItEnds) {
  IdealFloor floor({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  Exploration dut({}, kWidth_m, {});
  EXPECT_LT(Explore(dut, floor), 20);
  EXPECT_GE(floor.Covered(dut.grid()), 0.98);
  EXPECT_NEAR(dut.driven_m(), floor.driven_m(), 0.3);
}

TEST(ExplorationTest, ThePlanIsClosedFromTheBeginning) {
  Exploration dut(
      {}, kWidth_m,
      {{{2, 0, 0}, {0.1, 2}}, {{-2, 0, 0}, {0.1, 2}}, {{0, 1, 0}, {2, 0.1}}, {{0, -1, 0}, {2, 0.1}}});
  for (double x = -1.2; x <= 1.2; x += 0.2) dut.NoteAt({x, 0, 0});
  EXPECT_FALSE(dut.Choose({1.2, 0, 0}));
  EXPECT_THAT(dut.left(), IsEmpty());
}

TEST(ExplorationTest, AGapThatIsTooNarrowIsLeftWithTheReason) {
  Exploration dut({}, kWidth_m,
                  {{{2, 1.45, 0}, {0.1, 1.05}},  // a gap of 80 cm
                   {{2, -1.45, 0}, {0.1, 1.05}},
                   {{-2, 0, 0}, {0.1, 2}},
                   {{0, 1.2, 0}, {2, 0.1}},
                   {{0, -1.2, 0}, {2, 0.1}}});
  for (double x = -1.2; x <= 1.2; x += 0.2) dut.NoteAt({x, 0, 0});
  EXPECT_FALSE(dut.Choose({1.2, 0, 0}));
  ASSERT_THAT(dut.left(), SizeIs(1));
  EXPECT_THAT(dut.left()[0].reason, HasSubstr("0.98 m width leads there"));
}

TEST(ExplorationTest, WhatWasGivenUpIsNotTriedBeforeItIsSaid) {
  Exploration dut({.sight_m = 0}, kWidth_m, {});
  dut.NoteAt({0, 0, 0});
  int n = 0;
  for (auto goal = dut.Choose({0, 0, 0}); goal && n < 100; goal = dut.Choose({0, 0, 0}), ++n)
    dut.GiveUp(goal->target, "the lift is out of order");
  EXPECT_GT(n, 3);
  EXPECT_LT(n, 30);
  ASSERT_THAT(dut.left(), SizeIs(1));
  EXPECT_EQ(dut.left()[0].reason, "the lift is out of order");
  EXPECT_TRUE(dut.TryAgain());
  EXPECT_TRUE(dut.Choose({0, 0, 0}));
  EXPECT_FALSE(dut.TryAgain()) << "nothing was given up since";
  dut.GiveUp({1.3, 0}, "seen from near by", true);
  EXPECT_FALSE(dut.TryAgain()) << "looking again shows no more";
  dut.Reset();
  dut.NoteAt({0, 0, 0});
  EXPECT_TRUE(dut.Choose({0, 0, 0}));
}

TEST(ExplorationTest, WhatIsTriedAgainIsTriedOnce) {
  Exploration dut({.sight_m = 0}, kWidth_m, {});
  dut.NoteAt({0, 0, 0});
  const auto give_all_up = [&] {
    int n = 0;
    for (auto goal = dut.Choose({0, 0, 0}); goal && n < 100; goal = dut.Choose({0, 0, 0}), ++n)
      dut.GiveUp(goal->target, "somebody stands there");
    return n;
  };
  EXPECT_GT(give_all_up(), 0);
  ASSERT_TRUE(dut.TryAgain());
  EXPECT_GT(give_all_up(), 0);
  EXPECT_FALSE(dut.TryAgain());
}

TEST(ExplorationTest, InTheEndLittleIsNotWorthALongWay) {
  for (const double m2_per_m : {0.1, 10.0}) {
    ExplorationConfig config;
    config.gain_m2_per_m = m2_per_m;
    config.sight_m = 0;
    Exploration dut(config, kWidth_m, {});
    for (double x = 0; x <= 9; x += 0.2) dut.NoteAt({x, 0, 0});
    dut.Learn({1, 1, {WallAt(4.5, -1, 0, 12), WallAt(4.5, 1, 180, 12), WallAt(10.5, 0, 90, 2.2)}, {}});
    dut.GiveUp({9, 0}, "somebody stands there");
    ASSERT_TRUE(dut.TryAgain());
    EXPECT_EQ(dut.Choose({9, 0, 0}).has_value(), m2_per_m < 1) << "the other end of the corridor";
  }
}

TEST(ExplorationTest, WhatWasInSightIsNotDrivenTo) {
  for (const double sight_m : {0.0, 2.0}) {  // the middle of a room of 3.8 m x 3.8 m
    Exploration dut(
        {.sight_m = sight_m}, kWidth_m,
        {{{2, 0, 0}, {0.1, 2}}, {{-2, 0, 0}, {0.1, 2}}, {{0, 2, 0}, {2, 0.1}}, {{0, -2, 0}, {2, 0.1}}});
    dut.NoteAt({0, 0, 0});
    EXPECT_EQ(dut.Choose({0, 0, 0}).has_value(), sight_m == 0) << sight_m;
  }
}

TEST(ExplorationTest, ALongWayAroundHasToBeWorthIt) {
  const Exploration dut({.gain_m2_per_m = 0.5}, kWidth_m, {});
  const FrontierGoal goal{.way_m = 2, .gain_m2 = 3};
  EXPECT_TRUE(dut.IsWorth(goal, 7)) << "about as far as it seemed";
  EXPECT_FALSE(dut.IsWorth(goal, 8));
  EXPECT_TRUE(dut.IsWorth({.way_m = 2, .gain_m2 = 5}, 8));
}

TEST(ExplorationTest, TheWayBackLeavesLoopsOutAndLeadsToTheBeginning) {
  Exploration dut({}, kWidth_m, {});
  EXPECT_THAT(dut.WayBack(1), IsEmpty());
  for (double x = 0; x <= 3; x += 0.2) dut.NoteAt({x, 0, 0.5});
  EXPECT_NEAR(dut.WayBack(1).back().x, 2, 0.25);
  EXPECT_EQ(dut.WayBack(1).back().yaw, 0.5);
  EXPECT_NEAR(dut.WayBack(10).back().x, 0, 1e-9);
  // It went back once and stands there: the next way back does not lead to where it was stopped.
  for (double x = 2.8; x >= 1.9; x -= 0.2) dut.NoteAt({x, 0, 0.5});
  for (const Pose2& pose : dut.WayBack(1)) EXPECT_LT(pose.x, 2.0 + 1e-9);
  EXPECT_NEAR(dut.WayBack(1).back().x, 1, 0.2);
}

TEST(ExplorationTest, TheWayOnIsTheOneThatItTookWhenItWasHereFirst) {
  Exploration dut({}, kWidth_m, {});
  EXPECT_THAT(dut.WayOn(1), IsEmpty());
  for (double x = 0; x <= 3; x += 0.2) dut.NoteAt({x, 0, 0.5});
  EXPECT_THAT(dut.WayOn(1), IsEmpty()) << "it was never farther";
  for (double x = 2.8; x >= 1.9; x -= 0.2) dut.NoteAt({x, 0, 0.5});
  EXPECT_NEAR(dut.WayOn(0.5).back().x, 2.5, 0.25);
  EXPECT_EQ(dut.WayOn(0.5).back().yaw, 0.5);
}

TEST(ExplorationTest, AThingDoesNotCloseWhereTheBaseWasAndIsNoneWhereItDrives) {
  Exploration dut({}, kWidth_m, {});
  for (double x = 0; x <= 3; x += 0.2) dut.NoteAt({x, 0, 0});
  EXPECT_FALSE(dut.AddThing({{1, 0.3, 0}, {0.4, 0.4}}));
  EXPECT_FALSE(dut.Knows({1, 0.3}, {0, 0}));
  EXPECT_TRUE(dut.AddThing({{1, 0.9, 0}, {0.4, 0.4}})) << "the jamb of an opening that it passed";
  EXPECT_TRUE(dut.Knows({1, 0.9}, {0, 0}));
  EXPECT_FALSE(dut.Knows({1, 0.2}, {0, 0})) << "it is smaller";
  EXPECT_TRUE(dut.AddThing({{4.4, 0, 0}, {0.4, 0.4}}));
  dut.NoteAt({3.8, 0, 0});
  EXPECT_FALSE(dut.Knows({4.2, 0}, {0, 0}));
}

TEST(ExplorationTest, WhatTheHeadSawIsKeptOffButDoesNotCloseWhereTheBaseWas) {
  Exploration dut({}, kWidth_m, {});
  for (double x = 0; x <= 3; x += 0.2) dut.NoteAt({x, 0, 0});
  dut.Learn({}, {{"thing 1", {{1, 0.3, 0}, {0.2, 0.2}}}, {"thing 2", {{3.9, 0, 0}, {0.2, 0.3}}}});
  EXPECT_FALSE(dut.Knows({1, 0.3}, {0, 0}));
  EXPECT_TRUE(dut.Knows({3.9, 0}, {0, 0}));
  EXPECT_EQ(dut.grid().At(Eigen::Vector2d(3.9, 0)), ExploredGrid::Cell::kClosed);
  const auto obstacles = dut.ThingsForWays();
  ASSERT_FALSE(obstacles.empty());
  EXPECT_EQ(obstacles.back().name, "a thing that the head saw");
  EXPECT_EQ(obstacles.back().shape.map_from_centre.x, 3.9);
  dut.Learn({});
  EXPECT_FALSE(dut.Knows({3.9, 0}, {0, 0})) << "it is told of no more";
}

TEST(ExplorationTest, WhatWasHeardIsKnownWhereAThingOrAWallStands) {
  Exploration dut({}, kWidth_m, {});
  EXPECT_FALSE(dut.Knows({2, 1}, {0, 0}));
  dut.AddThing({{2, 1.3, 0}, {0.2, 0.2}});
  EXPECT_TRUE(dut.Knows({2, 1}, {0, 0}));
  EXPECT_FALSE(dut.Knows({2, 0.3}, {0, 0}));
}

TEST(ExplorationTest, AnEchoOfAnEdgeLiesAnywhereOnItsArc) {
  Exploration dut({}, kWidth_m, {});
  LearnedWalls walls;
  walls.points = {{8.08, 0.67, 0.02, 0}};
  dut.Learn(walls);
  EXPECT_TRUE(dut.Knows({8.21, 0.38}, {7.31, -0.27}));
  EXPECT_FALSE(dut.Knows({8.46, -0.27}, {7.31, -0.27})) << "in another direction";
  EXPECT_FALSE(dut.Knows({8.6, 0.7}, {7.31, -0.27})) << "farther away";
}

TEST(ExplorationTest, WhatIsTooFarIsLeft) {
  Exploration dut({.farthest_m = 5}, kWidth_m, {});
  for (double x = 0; x <= 6; x += 0.2) dut.NoteAt({x, 0, 0});
  const auto goal = dut.Choose({6, 0, 0});
  ASSERT_TRUE(goal);
  EXPECT_LT(goal->target.norm(), 5);
}

TEST(ExplorationTest, TheUnknownIsInTheWayExceptWhereItIsToBeSeen) {
  Exploration dut({}, kWidth_m, {});
  for (double x = 0; x <= 4; x += 0.2) dut.NoteAt({x, 0, 0});
  const auto goal = dut.Choose({4, 0, 0});
  ASSERT_TRUE(goal);
  bool behind = false;
  for (const NamedObstacle& obstacle : dut.UnknownFor(*goal)) {
    EXPECT_GT(Distance(obstacle.shape, goal->goal), 1.1);
    behind = behind || Distance(obstacle.shape, Eigen::Vector2d(-1.3, 0)) < 0.2;
  }
  EXPECT_TRUE(behind);
}

TEST(ExplorationTest, TheRivalTakesTheNearestFrontier) {
  ExplorationConfig config;
  config.rule = "nearest";
  Exploration dut(config, kWidth_m, {});
  for (double x = 0; x <= 8; x += 0.2) dut.NoteAt({x, 0, 0});
  dut.Learn({1, 1, {WallAt(4, -1, 0, 7), WallAt(4, 1, 180, 7)}, {}});
  const auto goal = dut.Choose({2, 0, 0});
  ASSERT_TRUE(goal);
  EXPECT_LT(goal->target.x(), 1);
}

/// Squares that hang together, drawn one after the other.
std::vector<std::pair<int, int>> DrawFloor() {
  std::vector<std::pair<int, int>> squares{{0, 0}};
  const int n = *rc::gen::inRange(1, 10);
  for (int i = 0; i < n; ++i) {
    const auto at = squares[*rc::gen::inRange<std::size_t>(0, squares.size())];
    const int side = *rc::gen::inRange(0, 4);
    const std::pair<int, int> next{at.first + (side == 0) - (side == 1),
                                   at.second + (side == 2) - (side == 3)};
    if (std::find(squares.begin(), squares.end(), next) == squares.end()) squares.push_back(next);
  }
  return squares;
}

RC_GTEST_PROP(ExplorationTest, OfAnyFloorEverythingIsSeenAndItEnds, ()) {
  IdealFloor floor(DrawFloor());
  ExplorationConfig config;
  config.grid.near_m = config.sight_m;  // what was in sight is not driven to
  Exploration dut(config, kWidth_m, {});
  RC_ASSERT(Explore(dut, floor) < 400);
  const double covered = floor.Covered(dut.grid());
  if (covered < 0.98) RC_LOG() << "covered " << covered << "\n";
  RC_ASSERT(covered >= 0.98);
}

}  // namespace
}  // namespace priamos::planner
