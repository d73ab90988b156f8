#include "planner/core/explore/presumed_corners.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

const CornerConfig kCorners;

/// Two walls of a room whose corner is at (3, 0): one along x with the room above, one along y with the room
/// to its left; so much of each is missing.
LearnedWalls Corner(double of_first_m, double of_second_m) {
  return {1,
          1,
          {WallAt(1.5 - of_first_m / 2, 0, 0, 3 - of_first_m),
           WallAt(3, 1.5 + of_second_m / 2, 90, 3 - of_second_m)},
          {}};
}

TEST(PresumedCornersTest, WhatIsMissingToTheCornerIsPresumed) {
  const auto pieces = PresumedCorners(Corner(0.6, 0.4), kCorners);
  ASSERT_THAT(pieces, SizeIs(2));
  EXPECT_NEAR(pieces[0].length_m, 0.6, 1e-9);
  EXPECT_LT((pieces[0].to() - Eigen::Vector2d(3, 0)).norm(), 1e-9);
  EXPECT_NEAR(pieces[1].length_m, 0.4, 1e-9);
  EXPECT_LT((pieces[1].from() - Eigen::Vector2d(3, 0)).norm(), 1e-9);
}

TEST(PresumedCornersTest, ThroughMoreTheBaseMayFit) {
  EXPECT_THAT(PresumedCorners(Corner(1.0, 0.2), kCorners), IsEmpty());
  EXPECT_THAT(PresumedCorners(Corner(0.2, 1.0), kCorners), IsEmpty());
}

TEST(PresumedCornersTest, WhereTheCornerWasHeardMoreMayBeMissing) {
  LearnedWalls walls = Corner(1.8, 1.2);
  walls.points = {{3.1, -0.1, 0.02, 0}};
  EXPECT_THAT(PresumedCorners(walls, kCorners), SizeIs(2));
  walls.points = {{2.2, 0, 0.02, 0}};  // an edge elsewhere
  EXPECT_THAT(PresumedCorners(walls, kCorners), IsEmpty());
}

TEST(PresumedCornersTest, AWallThatIsToldTooLongEndsThere) {
  EXPECT_THAT(PresumedCorners(Corner(-0.2, 0.5), kCorners), SizeIs(1));
  EXPECT_THAT(PresumedCorners(Corner(-0.5, 0.5), kCorners), IsEmpty());
}

TEST(PresumedCornersTest, OnlyTheRoomBeforeBothHasACorner) {
  LearnedWalls walls = Corner(0.5, 0.5);
  walls.walls[1].yaw_deg = -90;  // heard from outside
  EXPECT_THAT(PresumedCorners(walls, kCorners), IsEmpty());
  walls.walls[1].yaw_deg = 60;
  EXPECT_THAT(PresumedCorners(walls, kCorners), IsEmpty());
}

}  // namespace
}  // namespace priamos::planner
