#include <gmock/gmock.h>

#include "planner/core/map/door_sides.hpp"
#include "planner/core/path/door_planner.hpp"
#include "planner/core/path/door_router.hpp"
#include "test/planner/core/plans.hpp"

// Into the cabin of an elevator and out of it.

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

/// The shipped cabin with another depth and width [m].
GroundPlan Cabin(double depth_m, double width_m) {
  GroundPlan plan = ElevatorPlan();
  const double right = 2.4 - width_m / 2 - 0.07, left = 2.4 + width_m / 2 + 0.07,
               back = 6.07 + depth_m + 0.07;
  for (WallPlan& wall : plan.walls) {
    if (wall.name == "cabin right") wall = {wall.name, {6, right}, {back, right}, 0.14};
    if (wall.name == "cabin left") wall = {wall.name, {6, left}, {back, left}, 0.14};
    if (wall.name == "cabin back") wall = {wall.name, {back, right - 0.07}, {back, left + 0.07}, 0.14};
  }
  return plan;
}

DoorPlanner PlannerFor(const GroundPlan& plan) {
  return DoorPlanner(DoorPlannerConfig{}, Footprint{}, plan);
}

DoorRouter RouterFor(const GroundPlan& plan) {
  return {DoorRouterConfig{}, RoutePlannerConfig{}, DoorPlannerConfig{}, Footprint{}, plan};
}

TEST(Cabin, ThePathIntoItEndsInItsMiddle) {
  for (const double depth_m : {1.05, 1.10, 1.40}) {
    const GroundPlan plan = Cabin(depth_m, 1.10);
    const auto path = PlannerFor(plan).PlanPassage(plan.doors[0], {3.5, 2.4, 0});
    ASSERT_TRUE(path) << path.reason();
    EXPECT_NEAR(path->points.back().x, 6.07 + depth_m / 2, 0.02) << depth_m;
  }
}

TEST(Cabin, OneThatIsTooShallowIsRefused) {
  const GroundPlan plan = Cabin(0.94, 1.10);
  const auto path = PlannerFor(plan).PlanPassage(plan.doors[0], {3.5, 2.4, 0});
  ASSERT_FALSE(path);
  EXPECT_THAT(path.reason(), HasSubstr("cabin back"));
}

TEST(Cabin, ItIsKnownByItsWallsAndARoomOrACorridorIsNone) {
  for (const double width_m : {1.10, 2.0}) {
    const GroundPlan plan = Cabin(1.40, width_m);
    const auto place = PlannerFor(plan).CabinPlace(FromBehind(plan.doors[0]));
    ASSERT_TRUE(place) << width_m;
    EXPECT_NEAR(place->x, 6.77, 0.02);
    EXPECT_NEAR(place->yaw, 0, 1e-9);
  }
  EXPECT_FALSE(PlannerFor(Cabin(1.40, 4.0)).CabinPlace(FromBehind(ElevatorPlan().doors[0]))) << "a corridor";
  EXPECT_FALSE(PlannerFor(Cabin(3.0, 1.10)).CabinPlace(FromBehind(ElevatorPlan().doors[0]))) << "a room";
  EXPECT_FALSE(PlannerFor(ElevatorPlan()).CabinPlace(ElevatorPlan().doors[0])) << "the landing";
}

TEST(Cabin, OutOfItTheBaseDrivesAsItStands) {
  const GroundPlan plan = Cabin(1.40, 1.40);
  const DoorPlan out = FromBehind(plan.doors[0]);
  for (const double yaw : {0.05, kPi - 0.05}) {
    const auto path = PlannerFor(plan).PlanLeave(out, {6.77, 2.42, yaw});
    ASSERT_TRUE(path) << path.reason();
    EXPECT_NEAR(path->points.back().x, 4.5, 1e-9);
    EXPECT_NEAR(std::abs(path->points.back().yaw), yaw < 1 ? 0 : kPi, 1e-9);
    EXPECT_NEAR(path->min_gap_m, 0.06, 1e-6);
  }
}

TEST(Cabin, ARouteLeadsInAndOut) {
  GroundPlan plan = ElevatorPlan();
  ASSERT_EQ(plan.doors[0].behind_id, 0) << "no landmark is needed in it";
  auto dut = RouterFor(plan);
  const auto in = dut.Plan({2, 2.4, 0}, {{6.77, 2.4, 0}});
  ASSERT_TRUE(in) << in.reason();
  EXPECT_EQ(in->front().door_id, 1);
  const auto out = dut.Plan({6.77, 2.4, 0}, {{2, 1.2, 0}});
  ASSERT_TRUE(out) << out.reason();
  EXPECT_EQ(out->front().door_id, 1);
  EXPECT_EQ(dut.PlanThrough({6.77, 2.41, 0.02}, 1).size(), 1u);
  EXPECT_TRUE(dut.PlaceInCabin(1));
  EXPECT_FALSE(dut.PlaceInCabin(2));
}

}  // namespace
}  // namespace priamos::planner
