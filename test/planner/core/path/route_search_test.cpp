#include "planner/core/path/route_search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

SweptFootprint SpaceOf(const GroundPlan& plan) {
  return SweptFootprint(Footprint{}, ObstacleMap(plan));
}

double LengthOf(const std::vector<Pose2>& route) {
  double length_m = 0;
  for (std::size_t i = 1; i < route.size(); ++i)
    length_m += (route[i].translation() - route[i - 1].translation()).norm();
  return length_m;
}

TEST(SearchRouteTest, ItBeginsAtTheStartAndEndsAtTheGoalExactly) {
  const RouteQuery query{.start = {1.03, 2.38, 0.1}, .goal = {4.51, 1.27, 1.0}};
  const auto dut = SearchRoute(SpaceOf(ShippedPlan()), query);
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->front().x, 1.03);
  EXPECT_EQ(dut->front().yaw, 0.1);
  EXPECT_NEAR(dut->back().x, 4.51, 1e-12);
  EXPECT_NEAR(dut->back().y, 1.27, 1e-12);
  EXPECT_NEAR(dut->back().yaw, 1.0, 1e-12);
  EXPECT_LT(LengthOf(*dut), 1.15 * std::hypot(3.48, 1.11));
}

TEST(SearchRouteTest, WithoutAHeadingToHaveItKeepsItsOwnOrTurnsAsItLikes) {
  const auto dut =
      SearchRoute(SpaceOf(ShippedPlan()), {.start = {1, 2.4, 0.3}, .goal = {4, 2.4, 2}, .turn = false});
  ASSERT_TRUE(dut);
  EXPECT_LT(std::abs(dut->back().yaw), 0.8) << "driving forward is cheaper";
}

TEST(SearchRouteTest, EveryStepKeepsTheMargin) {
  GroundPlan plan = ShippedPlan();
  plan.walls.push_back({"screen", {2.5, 0}, {2.5, 3.4}, 0.1});
  const SweptFootprint space = SpaceOf(plan);
  const auto dut =
      SearchRoute(space, {.start = {1, 1, 0}, .goal = {4, 1, 0}, .margin_m = 0.2, .leaving_m = 0.2});
  ASSERT_TRUE(dut);
  for (std::size_t i = 1; i < dut->size(); ++i)
    EXPECT_GE(space.Along((*dut)[i - 1], (*dut)[i]).distance_m, 0.2 - 1e-3) << i;
}

TEST(SearchRouteTest, AGapThatFitsLengthwiseOnlyIsPassedLengthwise) {
  GroundPlan plan = ShippedPlan();
  plan.walls.push_back({"lower screen", {3, 0}, {3, 1.9}, 0.1});
  plan.walls.push_back({"upper screen", {3, 2.9}, {3, 4.8}, 0.1});  // 1 m between them
  const auto dut = SearchRoute(
      SpaceOf(plan),
      {.start = {1.2, 2.4, kPi / 2}, .goal = {4.8, 2.4, kPi / 2}, .margin_m = 0.08, .leaving_m = 0.08});
  ASSERT_TRUE(dut);
  for (const Pose2& pose : *dut) {
    if (std::abs(pose.x - 3) < 0.3) {
      EXPECT_GT(std::abs(std::cos(pose.yaw)), 0.9) << "beside the screens";
    }
  }
}

/// A base anywhere before an opening, as it likes to be turned: places and headings of the lattice, which are
/// counted from start and goal, need not fit.
RC_GTEST_PROP(SearchRouteTest, AnOpeningThatIsWideEnoughIsPassed, ()) {
  const double width_m = *rc::gen::inRange(99, 125) / 100.0,
               turned = *rc::gen::inRange(-180, 180) * kPi / 180, x = *rc::gen::inRange(-25, -11) / 10.0,
               y = *rc::gen::inRange(-150, 150) / 100.0, yaw = *rc::gen::inRange(-180, 180) * kPi / 180;
  ObstacleMap map{GroundPlan{}};
  const Pose2 map_from_wall{3, 2, turned};
  for (const double side : {1.0, -1.0})
    map.Add("wall", {map_from_wall * Pose2{0, side * (width_m / 2 + 3), 0}, {0.05, 3}});
  const SweptFootprint space(Footprint{}, map);
  RouteQuery query{.start = map_from_wall * Pose2{x, y, yaw}, .goal = map_from_wall * Pose2{1.4, y / 3, 0}};
  query.turn = false;
  query.passages = NarrowPassagesOf(map, 0.98, 1.7);
  query.margin_m = query.leaving_m = 0.1;
  const auto dut = SearchRoute(space, query);
  RC_ASSERT(dut.has_value());
  for (std::size_t i = 1; i < dut->size(); ++i)
    RC_ASSERT(space.Along((*dut)[i - 1], (*dut)[i]).distance_m > 0.1 - 1e-3);
}

TEST(SearchRouteTest, WhoStandsInANarrowPassageDrivesOn) {
  ObstacleMap map{GroundPlan{}};
  for (const double side : {1.0, -1.0}) map.Add("wall", {{0, side * 3.52, 0}, {0.05, 3}});
  const SweptFootprint space(Footprint{}, map);
  RouteQuery query{.start = {0.1, 0.03, 0.05}, .goal = {3, 1, 0.4}, .leaving_m = 0.05};
  query.passages = NarrowPassagesOf(map, 0.98, 1.7);
  EXPECT_TRUE(SearchRoute(space, query));
}

TEST(SearchRouteTest, InANarrowCorridorItNeedNotDriveToItsEnds) {
  ObstacleMap map{GroundPlan{}};
  for (const double side : {1.0, -1.0}) map.Add("wall", {{0, side * 0.7, 0}, {8, 0.05}});  // 1.3 m
  const SweptFootprint space(Footprint{}, map);
  RouteQuery query{.start = {-2, 0.02, 0}, .goal = {2, 0, 0}};
  query.passages = NarrowPassagesOf(map, 0.98, 1.4);
  EXPECT_EQ(query.passages.size(), 1U);
  const auto dut = SearchRoute(space, query);
  ASSERT_TRUE(dut);
  EXPECT_LT(LengthOf(*dut), 4.3);
}

TEST(SearchRouteTest, WhereNoWayLeadsThereIsNone) {
  EXPECT_FALSE(SearchRoute(SpaceOf(ShippedPlan()), {.start = {1, 2.4, 0}, .goal = {8, 2.4, 0}}));
  EXPECT_FALSE(SearchRoute(SpaceOf(ShippedPlan()), {.start = {1, 2.4, 0}, .goal = {4, 0.2, 0}}));
}

TEST(SearchRouteTest, WhoStandsNearAWallLeavesIt) {
  const RouteQuery query{.start = {2, 0.43, 0}, .goal = {4, 2.4, 0}, .leaving_m = 0.03};
  EXPECT_TRUE(SearchRoute(SpaceOf(ShippedPlan()), query));
}

TEST(SearchRouteTest, WhoIsThereNeedsNoWay) {
  const auto dut = SearchRoute(SpaceOf(ShippedPlan()), {.start = {2, 2.4, 0}, .goal = {2, 2.4, 0}});
  ASSERT_TRUE(dut);
  EXPECT_LT(LengthOf(*dut), 1e-9);
}

}  // namespace
}  // namespace priamos::planner
