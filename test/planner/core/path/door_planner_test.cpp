#include "planner/core/path/door_planner.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "common/random.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

struct Fixture {
  GroundPlan plan = ShippedPlan();
  DoorPlannerConfig config;
  Footprint footprint;
  DoorPlanner Make() const { return DoorPlanner(config, footprint, plan); }
  const DoorPlan& door() const { return plan.doors[0]; }
};

TEST(DoorPlanner, FromTheAxisItGoesStraightThrough) {
  const Fixture f;
  const auto path = f.Make().PlanPassage(f.door(), {3.5, 2.4, 0});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_NEAR(path->min_gap_m, 0.06, 1e-9);
  EXPECT_NEAR(path->points.back().x, 7.5, 1e-9);
  for (const Pose2& point : path->points) {
    EXPECT_NEAR(point.y, 2.4, 1e-9);
    EXPECT_NEAR(point.yaw, 0, 1e-9);
  }
}

TEST(DoorPlanner, PrefersALongStraightRunBeforeTheDoor) {
  const Fixture f;
  const auto path = f.Make().PlanPassage(f.door(), {3.5, 2.6, 0.1});
  ASSERT_TRUE(path) << path.reason();
  ASSERT_EQ(path->points.size(), 2u);
  EXPECT_NEAR(path->points[0].x, 6 - 1.6, 1e-9);
}

TEST(DoorPlanner, AlignsLaterWhenItIsAlreadyNear) {
  const Fixture f;
  const auto path = f.Make().PlanPassage(f.door(), {6 - 1.75, 2.45, 0});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_GT(path->points[0].x, 6 - 1.55);
  EXPECT_LE(path->points[0].x, 6 - 1.15 + 1e-9);
}

TEST(DoorPlanner, SideStepsWhenThereIsNoRunIn) {
  const Fixture f;
  const auto path = f.Make().PlanPassage(f.door(), {6 - 1.3, 3.4, 0});
  ASSERT_TRUE(path) << path.reason();
  ASSERT_EQ(path->points.size(), 2u);
  EXPECT_NEAR(path->points[0].x, 6 - 1.3, 1e-9);
}

TEST(DoorPlanner, BacksOffWhenItStandsTooNearToTheWall) {
  const Fixture f;
  const auto path = f.Make().PlanPassage(f.door(), {6 - 0.65, 3.9, 0});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_LT(path->points[0].x, 6 - 1.1);
}

TEST(DoorPlanner, BacksOffFartherWhereThePreferredPlaceIsNotFree) {
  Fixture f;
  f.plan.walls.push_back({"post", {6 - 1.35, 2.4 + 0.49}, {6 - 1.25, 2.4 + 0.49}, 0.1});
  const auto path = f.Make().PlanPassage(f.door(), {6 - 1.9, 2.4 - 0.3, 0});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_NEAR(path->points[0].x, 6 - 2.1, 1e-9);
}

TEST(DoorPlanner, WhoStandsNearAWallKeepsNineTenthsOfThatDistance) {
  Fixture f;
  const double left_side = 2.4 + f.footprint.width_m / 2;
  f.plan.walls.push_back({"here", {1.9, left_side + 0.06 + 0.05}, {2.1, left_side + 0.06 + 0.05}, 0.1});
  EXPECT_TRUE(f.Make().PlanApproach(f.door(), {2.0, 2.4, 0}));
  f.plan.walls.push_back({"ahead", {3.4, left_side + 0.04 + 0.05}, {3.6, left_side + 0.04 + 0.05}, 0.1});
  EXPECT_THAT(f.Make().PlanApproach(f.door(), {2.0, 2.4, 0}).reason(),
              HasSubstr("within 0.04 m of wall 'ahead', it needs 0.05 m"));
}

TEST(DoorPlanner, RefusesADoorThatIsTooNarrow) {
  Fixture f;
  f.plan.doors[0].opening_width_m = 0.75;
  const auto path = f.Make().PlanPassage(f.door(), {3.5, 2.4, 0});
  EXPECT_THAT(path.reason(), HasSubstr("needs 0.80 m, opening is 0.75 m"));
}

TEST(DoorPlanner, RefusesADoorThatIsTooLow) {
  Fixture f;
  f.plan.doors[0].opening_height_m = 1.2;
  const auto path = f.Make().PlanPassage(f.door(), {3.5, 2.4, 0});
  EXPECT_THAT(path.reason(), HasSubstr("too low: needs 1.35 m, opening is 1.20 m"));
}

TEST(DoorPlanner, RefusesToStartBehindTheDoor) {
  const Fixture f;
  EXPECT_THAT(f.Make().PlanPassage(f.door(), {7.5, 2.4, 0}).reason(), HasSubstr("behind door 'laboratory'"));
  EXPECT_THAT(f.Make().PlanApproach(f.door(), {7.5, 2.4, 0}).reason(), HasSubstr("behind door 'laboratory'"));
}

TEST(DoorPlanner, RefusesToStartInAWall) {
  const Fixture f;
  EXPECT_THAT(f.Make().PlanPassage(f.door(), {3, 0.2, 0}).reason(),
              HasSubstr("where the map has wall 'south'"));
}

TEST(DoorPlanner, SeesAWallAcrossTheWay) {
  Fixture f;
  f.plan.walls.push_back({"shelf", {7.0, 2.2}, {7.0, 2.3}, 0.1});
  const auto path = f.Make().PlanPassage(f.door(), {3.5, 2.4, 0});
  EXPECT_THAT(path.reason(), HasSubstr("wall 'shelf'"));
}

TEST(DoorPlanner, ApproachLeadsOverTheAxisToTheHoldPoint) {
  const Fixture f;
  const auto path = f.Make().PlanApproach(f.door(), {2.0, 2.0, 0.1});
  ASSERT_TRUE(path) << path.reason();
  ASSERT_EQ(path->points.size(), 2u);
  EXPECT_NEAR(path->points[0].x, 4.0, 1e-9);
  EXPECT_NEAR(path->points[1].x, 6 - 0.085 - 1.1 - 0.475, 1e-9);
  EXPECT_NEAR(path->points[1].y, 2.4, 1e-9);
}

TEST(DoorPlanner, TheWayToTheDoorMayBeLeftAsFarAsWallsAllowTheDoorNot) {
  const GroundPlan plan = ShippedPlan();
  const DoorPlanner dut({}, {}, plan);
  const DoorPlan& door = plan.doors.front();
  const auto path = dut.PlanPassage(door, door.map_from_door() * Pose2{-4, 0.3, 0});
  ASSERT_TRUE(path) << path.reason();
  ASSERT_EQ(path->leeway.size(), 2u);
  EXPECT_GT(path->leeway[0].left_m, 1);
  EXPECT_GT(path->leeway[0].right_m, 1);
  EXPECT_EQ(path->leeway[1].left_m, 0);
  EXPECT_EQ(path->leeway[1].right_m, 0);
  // 2.4 m from the door's axis there is a wall.
  EXPECT_LT(path->leeway[0].left_m + Footprint().width_m / 2 + 0.3, 2.4);
}

TEST(DoorPlanner, SteepRunInBeforeASideStep) {
  const GroundPlan plan = ShippedPlan();
  const DoorPlanner dut({}, {}, plan);
  const DoorPlan& door = plan.doors.front();
  const auto path = dut.PlanPassage(door, door.map_from_door() * Pose2{-1.8, 0.8, 0});
  ASSERT_TRUE(path) << path.reason();
  EXPECT_NEAR((door.map_from_door().Inverse() * path->points.front()).x, -DoorPlannerConfig().align_least_m,
              1e-9);
}

TEST(DoorPlanner, ApproachFromBeyondTheHoldPointBacksOff) {
  const Fixture f;
  const auto path = f.Make().PlanApproach(f.door(), {5.2, 2.4, 0});
  ASSERT_TRUE(path) << path.reason();
  ASSERT_EQ(path->points.size(), 1u);
  EXPECT_LT(path->points[0].x, 5.2);
}

/// Smallest gap along a path, computed independently of the planner at random places.
double GapOn(const GroundPlan& plan, const Pose2& start, const std::vector<Pose2>& points, Rng& rng) {
  const ObstacleMap obstacles(plan);
  double gap_m = 1e9;
  Pose2 from = start;
  for (const Pose2& to : points) {
    for (int i = 0; i < 100; ++i) {
      const double t = rng.Uniform(0, 1);
      const Pose2 at{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                     from.yaw + t * WrapAngle(to.yaw - from.yaw)};
      gap_m = std::min(gap_m, obstacles.NearestTo(Footprint{}.At(at)).distance_m);
    }
    from = to;
  }
  return gap_m;
}

RC_GTEST_PROP(DoorPlanner, AnyStartBeforeAnyDoorPoseGivesAFreePath, (const unsigned seed)) {
  Rng rng(seed);
  Fixture f;
  const Pose2 new_from_map{rng.Uniform(-20, 20), rng.Uniform(-20, 20), rng.Uniform(-3.1, 3.1)};
  f.plan = Moved(ShippedPlan(), new_from_map);
  const Pose2 start =
      new_from_map * Pose2{rng.Uniform(0.8, 4.6), rng.Uniform(0.9, 3.9), rng.Uniform(-3.1, 3.1)};
  const auto path = f.Make().PlanPassage(f.door(), start);
  RC_ASSERT(path.reason() == "");
  RC_ASSERT(path->points.size() <= 16u);
  const double gap_m = GapOn(f.plan, start, path->points, rng);
  RC_ASSERT(gap_m > 0.05);
  RC_ASSERT(gap_m > path->min_gap_m - 0.005);
  const Pose2 end = f.door().map_from_door().Inverse() * path->points.back();
  RC_ASSERT(std::abs(end.x - 1.5) + std::abs(end.y) + std::abs(end.yaw) < 1e-9);
}

}  // namespace
}  // namespace priamos::planner
