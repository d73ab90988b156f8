#include "planner/core/explore/passages.hpp"

#include <gmock/gmock.h>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;
using testing::SizeIs;

/// A wall along x from 0 to 6 m, heard from above.
LearnedWalls Wall() {
  LearnedWall wall;
  wall.id = 7;
  wall.x_m = 3;
  wall.length_m = 6;
  wall.SetCovariance((Eigen::Matrix2d() << 4e-4, 1e-5, 1e-5, 1e-4).finished());
  LearnedWalls walls;
  walls.walls = {wall};
  return walls;
}

TEST(Passages, AWallBesideTheWayStaysAsItIs) {
  const auto left = WithoutPassages(Wall(), {Vector2d(0, 1), Vector2d(6, 1)}, 0.5);
  ASSERT_THAT(left.walls, SizeIs(1));
  EXPECT_EQ(left.walls[0].length_m, 6);
}

TEST(Passages, WhereTheBaseDroveThroughNoWallIs) {
  const auto left = WithoutPassages(Wall(), {Vector2d(2, 0.5), Vector2d(2, -0.5)}, 0.5);
  ASSERT_THAT(left.walls, SizeIs(2));
  EXPECT_NEAR(left.walls[0].from().x(), 0, 1e-9);
  EXPECT_NEAR(left.walls[0].to().x(), 1.5, 1e-9);
  EXPECT_NEAR(left.walls[1].from().x(), 2.5, 1e-9);
  EXPECT_NEAR(left.walls[1].to().x(), 6, 1e-9);
  EXPECT_EQ(left.walls[1].id, 7);
}

TEST(Passages, AWayBackThroughTheSameOpeningWidensItOnlyAsFarAsItWasElsewhere) {
  const auto left = WithoutPassages(
      Wall(), {Vector2d(2, 0.5), Vector2d(2, -0.5), Vector2d(2.4, -0.5), Vector2d(2.4, 0.5)}, 0.5);
  ASSERT_THAT(left.walls, SizeIs(2));
  EXPECT_NEAR(left.walls[0].to().x(), 1.5, 1e-9);
  EXPECT_NEAR(left.walls[1].from().x(), 2.9, 1e-9);
}

TEST(Passages, AnEndThatHangsIntoAnOpeningIsCutOff) {
  const auto left = WithoutPassages(Wall(), {Vector2d(6.3, 0.5), Vector2d(6.3, -0.5)}, 0.5);
  ASSERT_THAT(left.walls, SizeIs(1));
  EXPECT_NEAR(left.walls[0].to().x(), 5.8, 1e-9);
  EXPECT_THAT(WithoutPassages(Wall(), {Vector2d(7, 0.5), Vector2d(7, -0.5)}, 0.5).walls[0].length_m, 6);
}

TEST(Passages, APieceIsKnownAsWellAsTheWallIsThere) {
  const auto wall = Wall().walls[0];
  const auto left = WithoutPassages(Wall(), {Vector2d(2, 0.5), Vector2d(2, -0.5)}, 0.5);
  EXPECT_NEAR(left.walls[1].SigmaAt(0), wall.SigmaAt(1.25), 1e-6);
  EXPECT_NEAR(left.walls[1].SigmaAt(1), wall.SigmaAt(2.25), 1e-6);
}

TEST(Passages, AShortRestIsNothing) {
  EXPECT_THAT(WithoutPassages(Wall(), {Vector2d(0.6, 0.5), Vector2d(0.6, -0.5)}, 0.5).walls, SizeIs(1));
}

TEST(SureParts, EndBeforeTheEndsByTwoSigmas) {
  LearnedWalls walls = Wall();
  walls.walls[0].sigma_end_m = 0.05;
  EXPECT_NEAR(SureParts(walls).walls[0].length_m, 5.8, 1e-9);
  walls.walls[0].sigma_end_m = 0.4;
  EXPECT_NEAR(SureParts(walls).walls[0].length_m, 5.6, 1e-9);
}

TEST(SureParts, HaveNoShortPieces) {
  LearnedWalls walls = Wall();
  walls.walls[0].length_m = 0.8;
  walls.walls[0].sigma_end_m = 0.08;
  EXPECT_THAT(SureParts(walls).walls, SizeIs(0));
}

}  // namespace
}  // namespace priamos::planner
