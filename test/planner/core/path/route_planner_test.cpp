#include "planner/core/path/route_planner.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "test/planner/core/learned.hpp"
#include "test/planner/core/plans.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

RoutePlanner PlannerOf(const GroundPlan& plan) {
  return RoutePlanner({}, Footprint{}, plan);
}

TEST(RoutePlannerTest, AcrossAFreeRoomOneLineIsEnough) {
  const auto path = PlannerOf(ShippedPlan()).Plan({1, 2.4, 0}, {{4.6, 1.3, 1.2}});
  ASSERT_TRUE(path) << path.reason();
  ASSERT_EQ(path->points.size(), 2u) << "its last bit apart";
  EXPECT_NEAR((path->points[0].translation() - Eigen::Vector2d(4.6, 1.3)).norm(), 0.6, 1e-9);
  EXPECT_NEAR(path->points[1].yaw, 1.2, 1e-12);
  ASSERT_EQ(path->leeway.size(), 2u);
  EXPECT_GT(path->leeway[0].left_m, 0.5);
  EXPECT_EQ(path->leeway[1].left_m, 0) << "the goal is not left";
}

TEST(RoutePlannerTest, AroundAScreenItKeepsTheEasyMargin) {
  GroundPlan plan = ShippedPlan();
  plan.walls.push_back({"screen", {3, 0}, {3, 2.4}, 0.1});
  const auto path = PlannerOf(plan).Plan({1, 1, 0}, {{5, 1, 0}});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_GE(path->points.size(), 3u);
  EXPECT_LE(path->points.size(), 7u);
  EXPECT_GE(path->min_gap_m, 0.27 - 1e-3);
}

TEST(RoutePlannerTest, WhereTheEasyMarginLeadsNowhereTheLeastOneDoes) {
  GroundPlan plan = ShippedPlan();
  plan.walls.push_back({"screen", {3, 0}, {3, 3.6}, 0.1});  // 1.15 m are left
  const auto path = PlannerOf(plan).Plan({1, 1, 0}, {{5, 1, 0}});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_GE(path->min_gap_m, 0.1 - 1e-3);
}

TEST(RoutePlannerTest, AWideWayThatIsALongWayRoundIsNotTaken) {
  GroundPlan plan;
  plan.walls = {{"outer", {-2, -2}, {22, -2}, 0.1}, {"outer", {-2, 10}, {22, 10}, 0.1},
                {"outer", {-2, -2}, {-2, 10}, 0.1}, {"outer", {22, -2}, {22, 10}, 0.1},
                {"screen", {0.8, 3}, {20, 3}, 0.1}, {"screen", {-2, 3}, {-0.4, 3}, 0.1}};  // 1.2 m are left
  const Pose2 start{0.2, 0, kPi / 2};
  const auto path = PlannerOf(plan).Plan(start, {{0.2, 6, kPi / 2}});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_LT(LengthOf(start, path->points), 8) << "and not around the end of the screen, 40 m";
  EXPECT_GE(path->min_gap_m, 0.1 - 1e-3);
}

TEST(RoutePlannerTest, AMapThatIsTooLargeIsRefusedBeforeItIsSearched) {
  GroundPlan plan = ShippedPlan();
  plan.walls.push_back({"wall of another building", {400, 400}, {404, 400}, 0.1});
  const RoutePlanner dut = PlannerOf(plan);
  const auto path = dut.Plan({1, 1, 0}, {{5, 1, 0}});
  ASSERT_FALSE(path);
  EXPECT_THAT(path.reason(), HasSubstr("m, routes are looked for on 10000 m2"));
  EXPECT_FALSE(dut.FindPath({1, 1, 0}, {{5, 1, 0}}));
}

TEST(RoutePlannerTest, AWallThatIsNotOnThePlanIsPlannedAround) {
  RoutePlanner dut = PlannerOf(ShippedPlan());
  const Pose2 start{1, 2.4, 0};
  const Goal goal{{5, 2.4, 0}};
  const auto before = dut.Plan(start, goal);
  ASSERT_TRUE(before);
  EXPECT_TRUE(dut.AreFree(start, before->points));
  LearnedWalls learned;
  learned.walls = {WallAt(3, 2.4, 90, 1.5)};
  dut.Learn(learned, start);
  EXPECT_FALSE(dut.AreFree(start, before->points));
  const auto around = dut.Plan(start, goal);
  ASSERT_TRUE(around) << around.reason();
  EXPECT_GE(around->points.size(), 3u);
  EXPECT_TRUE(dut.AreFree(start, around->points));
  dut.Forget();
  EXPECT_FALSE(dut.AreFree(start, before->points))
      << "what was met on one mission is forgotten, walls are not";
  dut.Learn({}, start);
  EXPECT_TRUE(dut.AreFree(start, before->points));
}

TEST(RoutePlannerTest, NoWallIsWhereTheBaseStands) {
  RoutePlanner dut = PlannerOf(ShippedPlan());
  LearnedWalls learned;
  learned.walls = {WallAt(1, 2.4, 90, 0.8)};
  dut.Learn(learned, {1, 2.4, 0});
  EXPECT_TRUE(dut.Plan({1, 2.4, 0}, {{5, 2.4, 0}}));
  dut.Learn(learned, {3, 2.4, 0});
  EXPECT_FALSE(dut.AreFree({3, 2.4, 0}, {{1, 2.4, 0}}));
}

TEST(RoutePlannerTest, AThingThatTheHeadSawIsPlannedAroundButNotWhereTheBaseStands) {
  RoutePlanner dut = PlannerOf(ShippedPlan());
  LearnedWalls learned;
  learned.objects = {BoxAt(3, 2.4, 0)};
  const Pose2 start{1, 2.4, 0};
  dut.Learn(learned, start);
  EXPECT_EQ(dut.InTheWay(start, {{5, 2.4, 0}}), "thing 3, 0.60 x 0.40 m, seen by the head");
  const auto around = dut.Plan(start, {{5, 2.4, 0}});
  ASSERT_TRUE(around) << around.reason();
  EXPECT_EQ(dut.InTheWay(start, around->points), "");
  EXPECT_THAT(dut.Plan(start, {{3, 2.4, 0}}).reason(), HasSubstr("0.00 m of thing 3"));
  dut.Learn(learned, {2.8, 2.4, 0});
  EXPECT_TRUE(dut.Plan({2.8, 2.4, 0}, {{5, 2.4, 0}}));
}

TEST(RoutePlannerTest, CupboardsAreInTheWay) {
  GroundPlan plan = ShippedPlan();
  CupboardPlan cupboard;
  cupboard.name = "tools";
  cupboard.x_m = 3;
  cupboard.y_m = 2.4;
  plan.cupboards.push_back(cupboard);
  const auto path = PlannerOf(plan).Plan({1, 2.4, 0}, {{5, 2.4, 0}});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_GE(path->points.size(), 3u);
  EXPECT_THAT(PlannerOf(plan).Plan({1, 2.4, 0}, {{2.6, 2.4, 0}}).reason(), HasSubstr("cupboard 'tools'"));
}

TEST(RoutePlannerTest, WhatWasAddedIsAvoidedUntilItIsForgotten) {
  RoutePlanner dut = PlannerOf(ShippedPlan());
  dut.Add("box", {{3, 2.4, 0}, {0.3, 0.3}});
  EXPECT_GE(dut.Plan({1, 2.4, 0}, {{5, 2.4, 0}})->points.size(), 3u);
  dut.Forget();
  EXPECT_EQ(dut.Plan({1, 2.4, 0}, {{5, 2.4, 0}})->points.size(), 2u);
}

TEST(RoutePlannerTest, ADoorOnTheWayIsNamed) {
  EXPECT_EQ(PlannerOf(ShippedPlan()).Plan({1, 2.4, 0}, {{8, 2.4, 0}}).reason(),
            "the way to (8.00, 2.40) leads through door 'laboratory'; next: priamos mission door laboratory");
}

TEST(RoutePlannerTest, AWideDoorWithoutALeafIsAWayLikeAnyOther) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].opening_width_m = 1.3;
  plan.walls[4].to_m[1] = 1.75;
  plan.walls[5].from_m[1] = 3.05;
  EXPECT_FALSE(PlannerOf(plan).Plan({1, 2.4, 0}, {{8, 2.4, 0}})) << "its leaf may be closed";
  plan.doors[0].leaf = "none";
  const auto path = PlannerOf(plan).Plan({1, 2.4, 0}, {{8, 2.4, 0}});
  ASSERT_TRUE(path) << path.reason();
  plan.doors[0].leaf = "left";
  plan.doors[0].leaf_open_deg = 10;
  EXPECT_FALSE(PlannerOf(plan).Plan({1, 2.4, 0}, {{8, 2.4, 0}})) << "the plan has it ajar";
}

TEST(RoutePlannerTest, RefusalsSayWhy) {
  const RoutePlanner dut = PlannerOf(ShippedPlan());
  EXPECT_EQ(dut.Plan({1, 2.4, 0}, {{4, 0.45, 0}}).reason(),
            "at (4.00, 0.45) the base comes within 0.06 m of wall 'south', it needs 0.10 m");
  EXPECT_EQ(dut.Plan({1, 2.4, 0}, {{4, 0.3, 0}, false}).reason(),
            "the goal (4.00, 0.30) is 0.30 m from wall 'south', its middle needs 0.49 m");
  EXPECT_EQ(
      dut.Plan({1, 0.2, 0}, {{4, 2.4, 0}}).reason(),
      "the robot stands at (1.00, 0.20), where the map has wall 'south'; next: drive it clear by hand, or "
      "correct the map or the pose (priamos map, priamos where)");
  EXPECT_EQ(dut.Plan({1, 2.4, 0}, {{20, 2.4, 0}}).reason(), "no way of 0.98 m width leads to (20.00, 2.40)");
}

/// The shipped rooms with five boxes in the first one.
GroundPlan Furnished() {
  GroundPlan plan = ShippedPlan();
  for (int i = 0; i < 5; ++i) {
    const double x = support::Between(0.3, 5.5), y = support::Between(0.3, 4.5);
    const double direction = support::Between(0, kPi), half_m = support::Between(0.05, 0.4);
    const Eigen::Vector2d along(half_m * std::cos(direction), half_m * std::sin(direction));
    plan.walls.push_back(
        {"box", {x - along.x(), y - along.y()}, {x + along.x(), y + along.y()}, support::Between(0.05, 0.8)});
  }
  return plan;
}

RC_GTEST_PROP(RoutePlannerTest, AmongBoxesItNeverComesNearerThanTheLeastMargin, ()) {
  const GroundPlan plan = Furnished();
  const SweptFootprint space(Footprint{}, ObstacleMap(plan));
  const Pose2 start{support::Between(0.6, 5.4), support::Between(0.6, 4.2), support::Between(-kPi, kPi)};
  const Goal goal{{support::Between(0.6, 5.4), support::Between(0.6, 4.2), support::Between(-kPi, kPi)},
                  *rc::gen::arbitrary<bool>()};
  const auto path = PlannerOf(plan).Plan(start, goal);
  RC_CLASSIFY(bool(path), "found");
  if (!path) {
    RC_ASSERT(!path.reason().empty());
    return;
  }
  const Pose2& end = path->points.back();
  RC_ASSERT((end.translation() - goal.map_from_base.translation()).norm() < 1e-9);
  if (goal.turn) RC_ASSERT(std::abs(WrapAngle(end.yaw - goal.map_from_base.yaw)) < 1e-9);
  const double start_gap_m = space.DistanceAt(start);
  Pose2 from = start;
  for (const Pose2& to : path->points) {
    for (int i = 0; i <= 100; ++i) {
      const Pose2 pose = Between(from, to, i / 100.0);
      const bool leaving = (pose.translation() - start.translation()).norm() < 0.45;
      RC_ASSERT(space.DistanceAt(pose) > (leaving ? std::min(0.1, 0.9 * start_gap_m) : 0.1) - 2e-3);
    }
    from = to;
  }
}

}  // namespace
}  // namespace priamos::planner
