#include "common/learned/edge_walls.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

LearnedWall Wall(double x_m, double y_m, double yaw_deg, double length_m) {
  LearnedWall wall;
  wall.x_m = x_m;
  wall.y_m = y_m;
  wall.yaw_deg = yaw_deg;
  wall.length_m = length_m;
  return wall;
}

/// How many are left of a wall of 4 m along x from the origin and this one.
std::size_t Left(const LearnedWall& other) {
  LearnedWalls walls;
  walls.walls = {Wall(2, 0, 0, 4), other};
  return WithoutEdges(walls).walls.size();
}

TEST(EdgeWalls, APieceAskewAtTheEndOfAWallIsItsEdge) {
  EXPECT_EQ(Left(Wall(4.2, 0.2, 50, 0.8)), 1U);
  EXPECT_EQ(Left(Wall(-0.3, -0.1, -130, 1.2)), 1U);
}

TEST(EdgeWalls, NothingShortGoesAskewThroughAWall) {
  EXPECT_EQ(Left(Wall(2, 0.1, 60, 1)), 1U);
}

TEST(EdgeWalls, WallsAtRightAnglesAndParallelOnesStay) {
  EXPECT_EQ(Left(Wall(4.1, 0.4, 90, 0.8)), 2U);
  EXPECT_EQ(Left(Wall(4.1, 0.4, -95, 0.8)), 2U);
  EXPECT_EQ(Left(Wall(4.6, 0.1, 5, 0.8)), 2U);
}

TEST(EdgeWalls, WhatStandsAskewFarFromEndsStays) {
  EXPECT_EQ(Left(Wall(2, 1.2, 45, 1)), 2U);
  EXPECT_EQ(Left(Wall(5.5, 0, 45, 1)), 2U);
}

TEST(EdgeWalls, LongWallsStayHoweverTheyStand) {
  EXPECT_EQ(Left(Wall(4.2, 0.2, 45, 2.5)), 2U);
}

TEST(EdgeWalls, OfTwoThatAreAskewTheLongerOneStays) {
  LearnedWalls walls;
  walls.walls = {Wall(0.5, 0, 0, 1), Wall(1.1, 0.1, 45, 0.8)};
  const auto left = WithoutEdges(walls);
  ASSERT_EQ(left.walls.size(), 1U);
  EXPECT_EQ(left.walls[0].length_m, 1);
}

}  // namespace
}  // namespace priamos
