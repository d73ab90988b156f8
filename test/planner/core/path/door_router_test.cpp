#include "planner/core/path/door_router.hpp"

#include <gmock/gmock.h>

#include "common/random.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

DoorRouter RouterFor(const GroundPlan& plan) {
  return {DoorRouterConfig{}, RoutePlannerConfig{}, DoorPlannerConfig{}, Footprint{}, plan};
}

/// Numbers of the doors that legs lead through, 0 for a drive.
std::vector<int> Kinds(const std::vector<Leg>& legs) {
  std::vector<int> kinds;
  for (const Leg& leg : legs) kinds.push_back(leg.door_id.value_or(0));
  return kinds;
}

/// Three rooms in a row of 6 m, with door 1 between the first two and door 2 between the others.
GroundPlan ThreeRooms() {
  GroundPlan plan;
  const auto wall = [&](double x1, double y1, double x2, double y2) {
    plan.walls.push_back({"wall", {x1, y1}, {x2, y2}, 0.14});
  };
  wall(0, 0, 18, 0);
  wall(0, 5, 18, 5);
  wall(0, 0, 0, 5);
  wall(18, 0, 18, 5);
  for (const double x : {6.0, 12.0}) {
    wall(x, 0, x, 2.05);
    wall(x, 2.95, x, 5);
    DoorPlan door;
    door.id = x < 7 ? 1 : 2;
    door.behind_id = 100 + door.id;
    door.name = x < 7 ? "west" : "east";
    door.x_m = x;
    door.y_m = 2.5;
    plan.doors.push_back(door);
  }
  return plan;
}

TEST(DoorRouter, WithinARoomThereIsOneDrive) {
  auto dut = RouterFor(ShippedPlan());
  const auto legs = dut.Plan({1, 1, 0}, {{4.6, 1.3, kPi / 2}});
  ASSERT_TRUE(legs) << legs.reason();
  EXPECT_EQ(Kinds(*legs), std::vector<int>{0});
  EXPECT_EQ(legs->back().goal.map_from_base.x, 4.6);
  EXPECT_NEAR(legs->back().length_m, 3.6, 0.4);
}

TEST(DoorRouter, WhoStandsBeforeTheDoorPassesItAtOnce) {
  auto dut = RouterFor(ShippedPlan());
  const auto legs = dut.Plan({2.0, 2.4, 0}, {{8.3, 1.2, 0}});
  ASSERT_TRUE(legs) << legs.reason();
  EXPECT_EQ(Kinds(*legs), (std::vector<int>{1, 0}));
  EXPECT_NEAR((*legs)[0].length_m, 5.5, 0.01);
}

TEST(DoorRouter, WhoStandsElsewhereDrivesBeforeTheDoorFirst) {
  auto dut = RouterFor(ShippedPlan());
  for (const Pose2& start : {Pose2{2.0, 0.9, kPi}, Pose2{5.2, 0.9, 0}, Pose2{2.0, 2.4, kPi}}) {
    const auto legs = dut.Plan(start, {{8.3, 1.2, 0}});
    ASSERT_TRUE(legs) << legs.reason();
    ASSERT_EQ(Kinds(*legs), (std::vector<int>{0, 1, 0})) << start.x;
    const Pose2 before = (*legs)[0].goal.map_from_base;
    EXPECT_NEAR(before.x, 3.5, 0.01);
    EXPECT_NEAR(before.y, 2.4, 1e-9);
    EXPECT_NEAR(before.yaw, 0, 1e-9);
    const auto& instead = (*legs)[0].goal.instead;
    ASSERT_FALSE(instead.empty());
    EXPECT_NEAR(instead.front().x, before.x + 0.1, 1e-9);
    EXPECT_LT(instead.back().x, 5.2) << "before the door";
  }
}

TEST(DoorRouter, BackItLeadsThroughTheSameDoor) {
  auto dut = RouterFor(ShippedPlan());
  const auto legs = dut.Plan({8.3, 1.2, 0}, {{2, 2.4, kPi}});
  ASSERT_TRUE(legs) << legs.reason();
  ASSERT_EQ(Kinds(*legs), (std::vector<int>{0, 1, 0}));
  EXPECT_GT((*legs)[0].goal.map_from_base.x, 7.6);
  EXPECT_NEAR(std::abs((*legs)[0].goal.map_from_base.yaw), kPi, 1e-9);
  EXPECT_NEAR((*legs)[1].goal.map_from_base.x, 4.5, 1e-9);
}

TEST(DoorRouter, ADoorWithoutALandmarkBehindIsNotPassedBack) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].behind_id = 0;
  auto dut = RouterFor(plan);
  const auto legs = dut.Plan({8.3, 1.2, 0}, {{2, 2.4, kPi}});
  ASSERT_FALSE(legs);
  EXPECT_EQ(legs.reason(),
            "no way leads to (2.00, 2.40): door 'laboratory' has no landmark on its far side (behind_id)");
  EXPECT_TRUE(dut.Plan({2.0, 2.4, 0}, {{8.3, 1.2, 0}}));
}

TEST(DoorRouter, ATooNarrowDoorIsNamed) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].opening_width_m = 0.7;
  auto dut = RouterFor(plan);
  const auto legs = dut.Plan({2.0, 2.4, 0}, {{8.3, 1.2, 0}});
  ASSERT_FALSE(legs);
  EXPECT_THAT(legs.reason(), HasSubstr("door 'laboratory' is too narrow"));
}

TEST(DoorRouter, AGoalInAWallIsRefusedWithoutASearch) {
  auto dut = RouterFor(ShippedPlan());
  const auto legs = dut.Plan({2.0, 2.4, 0}, {{8.0, 0.2, 0}});
  ASSERT_FALSE(legs);
  EXPECT_THAT(legs.reason(), HasSubstr("wall 'south'"));
}

TEST(DoorRouter, ThroughSeveralRoomsTheDoorsFollowEachOther) {
  auto dut = RouterFor(ThreeRooms());
  const auto legs = dut.Plan({1, 2.5, 0}, {{16, 2.5, 0}});
  ASSERT_TRUE(legs) << legs.reason();
  // Behind the first door the base stands before the second one.
  EXPECT_EQ(Kinds(*legs), (std::vector<int>{1, 2, 0}));
  const auto back = dut.Plan({16, 1, kPi / 2}, {{1, 2.5, 0}});
  ASSERT_TRUE(back) << back.reason();
  EXPECT_EQ(Kinds(*back), (std::vector<int>{0, 2, 1, 0}));
}

TEST(DoorRouter, OfTwoDoorsTheNearerOneIsTaken) {
  GroundPlan plan = ThreeRooms();
  // Both rooms in the west become one with two doors in its eastern wall.
  plan.walls.erase(plan.walls.begin() + 4, plan.walls.begin() + 6);
  plan.doors[0].x_m = 12;
  plan.doors[0].y_m = 4.0;
  plan.walls[5] = {"wall", {12, 2.95}, {12, 3.55}, 0.14};
  plan.walls.push_back({"wall", {12, 4.45}, {12, 5}, 0.14});
  auto dut = RouterFor(plan);
  EXPECT_EQ(Kinds(*dut.Plan({2, 4.0, 0}, {{16, 4.0, 0}}))[0], 1);
  EXPECT_EQ(Kinds(*dut.Plan({2, 2.5, 0}, {{16, 2.0, 0}}))[0], 2);
}

TEST(DoorRouter, ADoorIsReachedFromBesideIt) {
  auto dut = RouterFor(ShippedPlan());
  EXPECT_EQ(Kinds(dut.PlanThrough({2.0, 2.4, 0}, 1)), std::vector<int>{1});
  auto far = RouterFor(ThreeRooms());
  EXPECT_EQ(Kinds(far.PlanThrough({3, 2.5, 0}, 2)), (std::vector<int>{1, 0, 2})) << "through the other room";
  EXPECT_EQ(Kinds(far.PlanThrough({17, 1, kPi / 2}, 1)), (std::vector<int>{0, 2, 0, 1}));
  EXPECT_EQ(Kinds(dut.PlanThrough({8.0, 2.4, kPi}, 1)), std::vector<int>{1}) << "from behind";
  EXPECT_EQ(Kinds(dut.PlanThrough({2.0, 2.4, 0}, 9)), std::vector<int>{9}) << "for the mission to refuse";
}

/// Wherever it starts and ends: the legs join, each drive can be planned, and each door is passed from the
/// side where the base is. Nothing but a place in or right beside a doorway is out of reach.
TEST(DoorRouter, LegsJoin) {
  const GroundPlan plan = ThreeRooms();
  auto dut = RouterFor(plan);
  const RoutePlanner route(RoutePlannerConfig{}, Footprint{}, plan);
  Rng random(5);
  const auto pose = [&] {
    return Pose2{random.Uniform(0.8, 17.2), random.Uniform(0.8, 4.2), random.Uniform(-3, 3)};
  };
  const auto at_a_doorway = [](const Pose2& p) { return std::abs(std::remainder(p.x, 6.0)) < 0.9; };
  for (int n = 0; n < 12;) {
    const Pose2 start = pose(), goal = pose();
    if (!route.IsFree(start) || !route.IsFree(goal) || at_a_doorway(start) || at_a_doorway(goal)) continue;
    ++n;
    const auto legs = dut.Plan(start, {goal});
    ASSERT_TRUE(legs) << legs.reason();
    Pose2 at = start;
    for (const Leg& leg : *legs) {
      const Pose2& to = leg.goal.map_from_base;
      if (leg.door_id) {
        const Pose2 door_from_map = plan.FindDoor(*leg.door_id)->map_from_door().Inverse();
        EXPECT_LT((door_from_map * at).x * (door_from_map * to).x, 0);
      } else {
        EXPECT_TRUE(route.FindPath(at, leg.goal));
      }
      at = to;
    }
    EXPECT_EQ(at.x, goal.x);
  }
}

}  // namespace
}  // namespace priamos::planner
