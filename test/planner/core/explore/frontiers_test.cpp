#include "planner/core/explore/frontiers.hpp"

#include <gmock/gmock.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

ExploredGrid GridOf(ExploredEvidence evidence) {
  return {ExploredGridConfig{}, evidence};
}

/// A corridor along x, 2 m wide, driven along from 0 to 4; its walls are told.
ExploredEvidence Corridor() {
  ExploredEvidence evidence;
  for (double x = 0; x <= 4; x += 0.2) evidence.trail.push_back({x, 0});
  evidence.walls.walls = {WallAt(2, -1, 0, 8), WallAt(2, 1, 180, 8)};
  return evidence;
}

TEST(FrontiersTest, OfNothingThereIsNone) {
  EXPECT_THAT(FrontiersOf(GridOf({}), 0.3), IsEmpty());
}

TEST(FrontiersTest, TheRimAroundABaseIsOne) {
  const auto frontiers = FrontiersOf(GridOf({{{3, 2}}, {}, {}}), 0.3);
  ASSERT_THAT(frontiers, SizeIs(1));
  EXPECT_NEAR(frontiers[0].length_m(), 2 * kPi * 1.3, 2);
  EXPECT_LT((frontiers[0].middle - Eigen::Vector2d(3, 2)).norm(), 0.1);
}

TEST(FrontiersTest, ACorridorHasOneAtEitherEnd) {
  const auto frontiers = FrontiersOf(GridOf(Corridor()), 0.3);
  ASSERT_THAT(frontiers, SizeIs(2));
  for (const Frontier& frontier : frontiers) {
    EXPECT_NEAR(frontier.middle.y(), 0, 0.15);
    EXPECT_NEAR(std::abs(frontier.middle.x() - 2), 3.5, 0.6);
    EXPECT_GT(frontier.length_m(), 1.5);
  }
}

TEST(FrontiersTest, AShortOneDoesNotCount) {
  ExploredEvidence evidence = Corridor();
  evidence.walls.walls.push_back(WallAt(5, 0, 90, 1.7));
  EXPECT_THAT(FrontiersOf(GridOf(evidence), 1.0), SizeIs(1));
}

TEST(FrontiersTest, WhatIsClosedHasNone) {
  ExploredEvidence evidence = Corridor();
  evidence.walls.walls.push_back(WallAt(5, 0, 90, 2.3));
  evidence.walls.walls.push_back(WallAt(-1, 0, -90, 2.3));
  EXPECT_THAT(FrontiersOf(GridOf(evidence), 0.3), IsEmpty());
}

}  // namespace
}  // namespace priamos::planner
