#include "planner/core/map/learned_obstacles.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// Of the shipped plan: a room from x 0 to 6, y 0 to 4.8.
std::vector<NamedObstacle> Of(const LearnedWall& wall) {
  LearnedWalls learned;
  learned.walls = {wall};
  return ObstaclesOf(learned, ObstacleMap(ShippedPlan()));
}

TEST(ObstaclesOf, AWallThatIsNotOnThePlanIsOne) {
  const auto dut = Of(WallAt(3, 2.4, 90, 1.5));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].name, "learned wall 1");
  EXPECT_NEAR(dut[0].shape.half_m.x(), 0.75, 0.01);
  // It was heard from the left of its direction, from -x; it stands behind the face that was heard.
  EXPECT_NEAR(dut[0].shape.map_from_centre.x, 3.02, 1e-6);
}

TEST(ObstaclesOf, AWallOfThePlanThatWasHeardIsNone) {
  EXPECT_THAT(Of(WallAt(3, 0.05, 0, 3)), IsEmpty());
  EXPECT_THAT(Of(WallAt(3, 0.15, 0, 3)), IsEmpty()) << "people measure to a few centimetres";
}

TEST(ObstaclesOf, WhatIsPartlyOnThePlanIsOneWhereItIsNot) {
  const auto dut = Of(WallAt(3, 0.9, 90, 2));
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_LT(dut[0].shape.half_m.x(), 0.9);
  EXPECT_GT(dut[0].shape.half_m.x(), 0.7);
}

TEST(ObstaclesOf, WhatIsHardlyKnownIsNone) {
  LearnedWall vague = WallAt(3, 2.4, 90, 1.5);
  vague.sigma_across_m = 0.2;
  EXPECT_THAT(Of(vague), IsEmpty());
  vague.sigma_across_m = 0.02;
  vague.sigma_yaw_deg = 15;
  const auto dut = Of(vague);
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_LT(dut[0].shape.half_m.x(), 0.65) << "its middle only";
}

}  // namespace
}  // namespace priamos::planner
