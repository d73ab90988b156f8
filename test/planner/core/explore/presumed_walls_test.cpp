#include "planner/core/explore/presumed_walls.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

const PresumedWallConfig kConfig{.told_m = 0};

/// Two walls of a room whose corner is at (3, 0): one along x with the room above, one along y with the room
/// to its left; so much of each is missing.
LearnedWalls Corner(double of_first_m, double of_second_m) {
  return {1,
          1,
          {WallAt(1.5 - of_first_m / 2, 0, 0, 3 - of_first_m),
           WallAt(3, 1.5 + of_second_m / 2, 90, 3 - of_second_m)},
          {}};
}

TEST(PresumedWallsTest, WhatIsMissingToTheCornerIsPresumed) {
  const auto pieces = PresumedWalls(Corner(0.6, 0.4), {}, kConfig);
  ASSERT_THAT(pieces, SizeIs(2));
  EXPECT_NEAR(pieces[0].length_m, 0.6, 1e-9);
  EXPECT_LT((pieces[0].to() - Eigen::Vector2d(3, 0)).norm(), 1e-9);
  EXPECT_NEAR(pieces[1].length_m, 0.4, 1e-9);
  EXPECT_LT((pieces[1].from() - Eigen::Vector2d(3, 0)).norm(), 1e-9);
}

TEST(PresumedWallsTest, ThroughMoreTheBaseMayFit) {
  EXPECT_THAT(PresumedWalls(Corner(1.0, 0.2), {}, kConfig), IsEmpty());
  EXPECT_THAT(PresumedWalls(Corner(0.2, 1.0), {}, kConfig), IsEmpty());
}

TEST(PresumedWallsTest, WhereTheCornerWasHeardMoreMayBeMissing) {
  LearnedWalls walls = Corner(2.2, 1.2);
  const std::vector<Eigen::Vector2d> past{{1.2, 1.2}, {1.8, 1.2}};
  EXPECT_THAT(PresumedWalls(walls, past, kConfig), IsEmpty());
  walls.points = {{3.1, -0.1, 0.02, 0}};
  EXPECT_THAT(PresumedWalls(walls, past, kConfig), SizeIs(2));
  EXPECT_THAT(PresumedWalls(walls, {}, kConfig), IsEmpty()) << "nobody was near the ends";
  walls.points.push_back({0.8, 0.1, 0.02, 0});
  EXPECT_THAT(PresumedWalls(walls, past, kConfig), IsEmpty()) << "an opening between it and the corner";
}

TEST(PresumedWallsTest, AnEdgeMayStillBeToldOfAnEndThatWasPassedJustNow) {
  const LearnedWalls walls = Corner(1.4, 0.2);
  std::vector<Eigen::Vector2d> trail;
  for (double x = 1; x > -2; x -= 0.2) trail.push_back({x, 1});  // 2.8 m on
  const PresumedWallConfig config{.told_m = 2};
  EXPECT_THAT(PresumedWalls(walls, trail, config), SizeIs(2));
  trail.resize(8);
  EXPECT_THAT(PresumedWalls(walls, trail, config), IsEmpty());
}

TEST(PresumedWallsTest, WhereTheBaseWasIsNoWall) {
  const LearnedWalls walls = Corner(1.4, 0.2);
  const std::vector<Eigen::Vector2d> through{{2.3, 0.6}, {2.3, 0}, {2.3, -0.6}};
  EXPECT_THAT(PresumedWalls(walls, through, kConfig), SizeIs(1));
}

TEST(PresumedWallsTest, AWallWhoseEndWasPassedAndIsNoEdgeGoesOn) {
  LearnedWalls walls = Corner(1.4, 0.2);
  const std::vector<Eigen::Vector2d> past{{1.6, 1}}, far{{0, 2.9}}, behind{{1.6, -1}};
  ASSERT_THAT(PresumedWalls(walls, past, kConfig), SizeIs(2));
  EXPECT_NEAR(PresumedWalls(walls, past, kConfig)[0].length_m, 1.4, 1e-9);
  EXPECT_THAT(PresumedWalls(walls, far, kConfig), IsEmpty());
  EXPECT_THAT(PresumedWalls(walls, behind, kConfig), IsEmpty());
  walls.points = {{1.6, 0.05, 0.02, 0}};
  EXPECT_THAT(PresumedWalls(walls, past, kConfig), IsEmpty()) << "an opening between it and the corner";
}

TEST(PresumedWallsTest, APieceThatIsMissingInAWallIsPresumedButNoOpening) {
  LearnedWalls walls{1, 1, {WallAt(1, 0, 0, 2), WallAt(4.3, 0.05, 0, 2)}, {}};
  const std::vector<Eigen::Vector2d> past{{2, 1}, {3.3, 1}};
  const auto pieces = PresumedWalls(walls, past, kConfig);
  ASSERT_THAT(pieces, SizeIs(1));
  EXPECT_NEAR(pieces[0].length_m, 1.3, 1e-9);
  EXPECT_LT((pieces[0].from() - Eigen::Vector2d(2, 0)).norm(), 1e-9);
  EXPECT_THAT(PresumedWalls(walls, {{1, 1}}, kConfig), IsEmpty()) << "its other end was not passed";
  walls.points = {{3.3, 0, 0.02, 0}};
  EXPECT_THAT(PresumedWalls(walls, past, kConfig), IsEmpty()) << "an edge of an opening";
}

TEST(PresumedWallsTest, AWallThatIsToldTooLongEndsThere) {
  EXPECT_THAT(PresumedWalls(Corner(-0.2, 0.5), {}, kConfig), SizeIs(1));
  EXPECT_THAT(PresumedWalls(Corner(-0.5, 0.5), {}, kConfig), IsEmpty());
}

TEST(PresumedWallsTest, OnlyTheRoomBeforeBothHasACorner) {
  LearnedWalls walls = Corner(0.5, 0.5);
  walls.walls[1].yaw_deg = -90;  // heard from outside
  EXPECT_THAT(PresumedWalls(walls, {}, kConfig), IsEmpty());
  walls.walls[1].yaw_deg = 60;
  EXPECT_THAT(PresumedWalls(walls, {}, kConfig), IsEmpty());
}

}  // namespace
}  // namespace priamos::planner
