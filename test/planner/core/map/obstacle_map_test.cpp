#include "planner/core/map/obstacle_map.hpp"

#include <gtest/gtest.h>

#include "planner/core/path/footprint.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

TEST(ObstacleMap, FootprintInTheMiddleOfTheDoorHasSixCentimetresOnEachSide) {
  const ObstacleMap dut(ShippedPlan());
  const auto nearest = dut.NearestTo(Footprint{}.At({6.0, 2.4, 0}));
  EXPECT_NEAR(nearest.distance_m, 0.06, 1e-9);
}

TEST(ObstacleMap, FrameStandsBeforeTheWall) {
  const ObstacleMap dut(ShippedPlan());
  // Front of the footprint at x = 5.9, beside the opening: 1.5 cm of architrave are nearer than the wall.
  const auto nearest = dut.NearestTo(Footprint{}.At({5.9 - 0.475, 2.0, 0}));
  EXPECT_NEAR(nearest.distance_m, 6.0 - 0.085 - 5.9, 1e-9);
  EXPECT_EQ(nearest.name, "frame of door 'laboratory'");
}

TEST(ObstacleMap, WallsAreNamed) {
  const ObstacleMap dut(ShippedPlan());
  const auto nearest = dut.NearestTo(Footprint{}.At({3.0, 0.5, 0}));
  EXPECT_NEAR(nearest.distance_m, 0.5 - 0.39, 1e-9);
  EXPECT_EQ(nearest.name, "wall 'south'");
}

TEST(ObstacleMap, ANoGoAreaIsInTheWayAsAWallIs) {
  GroundPlan plan;
  plan.no_go.push_back({"stairs", 3, 2, 90, 2, 1});
  const ObstacleMap dut(plan);
  const auto nearest = dut.NearestTo(Footprint{}.At({0, 2, 0}));
  EXPECT_NEAR(nearest.distance_m, 2.5 - 0.475, 1e-9);
  EXPECT_EQ(nearest.name, "no-go area 'stairs'");
}

TEST(ObstacleMap, EmptyPlanHasNoNearest) {
  const ObstacleMap dut(GroundPlan{});
  EXPECT_EQ(dut.NearestTo(Footprint{}.At({})).name, "");
}

}  // namespace
}  // namespace priamos::planner
