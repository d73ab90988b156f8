#include "planner/core/path/distance_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

const Eigen::Vector2d kStart(1, 2.4), kGoal(4, 2.4);

DistanceField FieldOf(const GroundPlan& plan, const Eigen::Vector2d& goal = kGoal, double margin_m = 0.1) {
  return DistanceField(SweptFootprint(Footprint{}, ObstacleMap(plan)), kStart, goal, margin_m, 1);
}

TEST(DistanceFieldTest, CellsAreCountedFromTheGoal) {
  const DistanceField dut = FieldOf(ShippedPlan());
  EXPECT_EQ(dut.PlaceOf(0, 0), kGoal);
  EXPECT_EQ(dut.ToGoal(0, 0), 0);
  EXPECT_NEAR(dut.PlaceOf(-3, 5).x(), 3.7, 1e-12);
  EXPECT_NEAR(dut.PlaceOf(-3, 5).y(), 2.9, 1e-12);
  EXPECT_EQ(dut.CellAt(dut.IndexOf(-3, 5)), std::pair(-3, 5));
}

TEST(DistanceFieldTest, ItHoldsTheObstaclesAndBothEndsAndALittleMore) {
  const DistanceField dut = FieldOf(ShippedPlan());
  EXPECT_TRUE(dut.Holds(-49, 0)) << "x = -0.9";
  EXPECT_FALSE(dut.Holds(-60, 0)) << "x = -2";
  EXPECT_TRUE(FieldOf(GroundPlan{}).Holds(-30, 0)) << "the start";
}

TEST(DistanceFieldTest, ClearanceIsThatOfThePlace) {
  EXPECT_NEAR(FieldOf(ShippedPlan()).Clearance(0, -10), 1.4, 1e-6) << "to the south wall";
}

TEST(DistanceFieldTest, TheWayLeadsAroundObstacles) {
  GroundPlan plan = ShippedPlan();
  const double straight_m = FieldOf(plan).ToGoal(-30, 0);
  EXPECT_NEAR(straight_m, 3, 1e-4);
  plan.walls.push_back({"screen", {2.5, 0}, {2.5, 3.4}, 0.1});
  const double around_m = FieldOf(plan).ToGoal(-30, 0);
  EXPECT_GT(around_m, 2 * std::hypot(1.5, 1.4));
  EXPECT_LT(around_m, 6);
}

TEST(DistanceFieldTest, NoWayIsInfinitelyFar) {
  GroundPlan plan = ShippedPlan();
  plan.walls.push_back({"screen", {2.5, 0}, {2.5, 4.8}, 0.1});
  EXPECT_TRUE(FieldOf(ShippedPlan()).ReachesStart());
  EXPECT_FALSE(FieldOf(plan).ReachesStart());
  EXPECT_TRUE(std::isinf(FieldOf(plan).ToGoal(-30, 0)));
  EXPECT_TRUE(std::isinf(FieldOf(ShippedPlan()).ToGoal(50, 0))) << "outside of the building";
}

TEST(DistanceFieldTest, TheDoorIsTooNarrowForTheMarginOnly) {
  EXPECT_TRUE(std::isinf(FieldOf(ShippedPlan()).ToGoal(35, 0)));
  EXPECT_NEAR(FieldOf(ShippedPlan(), kGoal, 0.02).ToGoal(35, 0), 3.5, 1e-4);
}

}  // namespace
}  // namespace priamos::planner
