#include "planner/core/path/narrow_passages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "planner/core/path/passage_lanes.hpp"

namespace priamos::planner {
namespace {

/// Between walls of 14 cm on the y axis, as wide as that, with an edge at each of their ends.
ObstacleMap Opening(double width_m) {
  ObstacleMap map{GroundPlan{}};
  for (const double side : {1.0, -1.0}) {
    map.Add("wall", {{0, side * (width_m / 2 + 2), 0}, {0.07, 2}});
    map.Add("edge", {{-0.07, side * width_m / 2, 0}, {0.02, 0.02}});
  }
  return map;
}

TEST(NarrowPassagesTest, AnOpeningIsOneFromEdgeToEdge) {
  const auto dut = NarrowPassagesOf(Opening(1.1), 0.98, 1.7);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0].width_m, 1.06, 1e-9);
  EXPECT_NEAR(dut[0].map_from_passage.x, -0.07, 1e-9);
  EXPECT_NEAR(dut[0].map_from_passage.y, 0, 1e-9);
  EXPECT_NEAR(std::abs(std::cos(dut[0].map_from_passage.yaw)), 1, 1e-9);
}

TEST(NarrowPassagesTest, WhatIsTooNarrowOrWideIsNone) {
  EXPECT_TRUE(NarrowPassagesOf(Opening(0.98), 0.98, 1.7).empty());
  EXPECT_TRUE(NarrowPassagesOf(Opening(1.9), 0.98, 1.7).empty());
}

TEST(NarrowPassagesTest, WhatStandsInTheMiddleLeavesNone) {
  ObstacleMap map = Opening(1.4);
  map.Add("post", {{-0.3, 0.1, 0}, {0.05, 0.05}});
  EXPECT_TRUE(NarrowPassagesOf(map, 0.98, 1.7).empty());
}

TEST(NarrowPassagesTest, ALineCrossesThemOrNot) {
  const NarrowPassage dut{{1, 2, kPi / 2}, 1.1};
  EXPECT_TRUE(dut.IsCrossedBy({1.2, 1}, {0.8, 3}));
  EXPECT_FALSE(dut.IsCrossedBy({1.2, 1}, {0.8, 1.9}));
  EXPECT_FALSE(dut.IsCrossedBy({2, 1}, {2, 3})) << "beside it";
  EXPECT_TRUE(dut.Holds({1, 0}, {1, 1.6}, 0.475)) << "with its front";
  EXPECT_FALSE(dut.Holds({1, 0}, {1, 1.4}, 0.475));
  EXPECT_FALSE(dut.Holds({2, 0}, {2, 4}, 0.475));
}

TEST(NarrowPassagesTest, ACorridorIsAsLongAsBothOfItsWalls) {
  ObstacleMap map{GroundPlan{}};
  map.Add("south", {{0, -0.57, 0}, {4, 0.05}});
  map.Add("north", {{1, 0.57, 0}, {4, 0.05}});
  const auto dut = NarrowPassagesOf(map, 0.98, 1.7);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0].width_m, 1.04, 1e-9);
  EXPECT_NEAR(dut[0].map_from_passage.x, 0.5, 1e-9);
  EXPECT_NEAR(dut[0].half_long_m, 3.5, 1e-9);
}

TEST(NarrowPassagesTest, WhatIsFreeIsSoForAllObstaclesHoweverCrowded) {
  for (const double side_m : {4.0, 9.0, 20.0}) {
    Rng rng(7);
    ObstacleMap map{GroundPlan{}};
    for (int i = 0; i < 120; ++i)
      map.Add("thing", {{rng.Uniform(0, side_m), rng.Uniform(0, side_m), rng.Uniform(-3, 3)},
                        {rng.Uniform(0.01, 0.2), 0.02}});
    for (const NarrowPassage& passage : NarrowPassagesOf(map, 0.9, 1.6))
      EXPECT_NEAR(map.NearestTo({passage.map_from_passage, {0, 0}}).distance_m, passage.width_m / 2, 0.0101);
    if (side_m > 5) {
      EXPECT_GT(NarrowPassagesOf(map, 0.9, 1.6).size(), 5u);
    }
  }
}

TEST(PassageLanesTest, WithoutRoomTheyBeginNearer) {
  ObstacleMap map = Opening(1.1);
  map.Add("far wall", {{-1.4, 0, 0}, {0.05, 3}});  // 1.28 m before the wall with the opening
  const auto dut = LanesThrough(NarrowPassagesOf(map, 0.98, 1.2), SweptFootprint(Footprint{}, map), 0.1);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_NEAR(std::abs(dut[0].before.x - dut[0].behind.x), 0.575 + 0.875 + 0.04, 1e-9)
      << "the edges are 4 cm long";
}

TEST(PassageLanesTest, TheyLeadThroughBothWaysWithTheWholeBody) {
  const ObstacleMap map = Opening(1.1);
  const SweptFootprint space(Footprint{}, map);
  const auto passages = NarrowPassagesOf(map, 0.98, 1.7);
  const auto dut = LanesThrough(passages, space, 0.1);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_NEAR(dut[0].before.x, -dut[1].before.x - 0.14, 1e-9);
  for (const PassageLane& lane : dut) {
    const Pose2 on_it = lane.before.Inverse() * lane.behind;
    EXPECT_NEAR(on_it.yaw, 0, 1e-9);
    EXPECT_NEAR(on_it.y, 0, 1e-9);
    EXPECT_GT(on_it.x, Footprint{}.length_m);
  }
  EXPECT_TRUE(LanesThrough(passages, space, 0.2).empty()) << "0.14 m are left to either side";
}

}  // namespace
}  // namespace priamos::planner
