#include "planner/core/explore/possible_floor.hpp"

#include <gtest/gtest.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

constexpr double kClearance_m = 0.44;

/// A base that was in the middle of a room of 4 m x 4 m, of which the walls are told but for their ends.
ExploredEvidence Room(double missing_m) {
  ExploredEvidence evidence;
  for (double x = -0.4; x <= 0.4; x += 0.2) evidence.trail.push_back({x, 0});
  for (const double yaw : {0.0, 90.0, 180.0, -90.0}) {
    const Eigen::Vector2d middle = Pose2{0, 0, Radians(yaw)} * Eigen::Vector2d(0, -2);
    evidence.walls.walls.push_back(WallAt(middle.x(), middle.y(), yaw, 4 - 2 * missing_m));
  }
  return evidence;
}

int CellsOf(const PossibleFloor& floor, const ExploredGrid& grid) {
  int count = 0;
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x) count += floor.Has({x, y}) ? 1 : 0;
  return count;
}

TEST(PossibleFloorTest, BehindAWallIsNone) {
  ExploredEvidence evidence;
  evidence.trail = {{0, 0}};
  const ExploredGrid open({.near_m = 1.3}, evidence);
  const PossibleFloor all(open, evidence.trail, kClearance_m, 0);
  EXPECT_GT(all.Behind_m2(open.CellOf({1.2, 0})), 3);
  evidence.walls = {1, 1, {WallAt(1.5, 0, 90, 20)}, {}};
  const ExploredGrid closed({.near_m = 1.3}, evidence);
  const PossibleFloor before(closed, evidence.trail, kClearance_m, 0);
  EXPECT_LT(before.Behind_m2(closed.CellOf({1.2, 0})), 2.2);
  EXPECT_FALSE(before.Has(closed.CellOf({2.5, 0})));
  EXPECT_TRUE(all.Has(open.CellOf({2.5, 0})));
}

TEST(PossibleFloorTest, TheCornersOfARoomAreNone) {
  const ExploredEvidence evidence = Room(0.5);
  const ExploredGrid grid({.near_m = 1.9}, evidence);
  const PossibleFloor floor(grid, evidence.trail, kClearance_m, 0);
  EXPECT_FALSE(floor.Has(grid.CellOf({3, 0})));
  EXPECT_FALSE(floor.Has(grid.CellOf({2.4, 2.4})));
  EXPECT_LT(floor.Behind_m2(grid.CellOf({1.3, 1.3})), 0.8);
}

TEST(PossibleFloorTest, AnOpeningLeadsThereWhereTheBaseFits) {
  for (const double width_m : {0.4, 1.6}) {  // the ends of both walls are doubtful
    ExploredEvidence evidence = Room(0);
    evidence.walls.walls[0] = WallAt(-1 - width_m / 4, -2, 0, 2 - width_m / 2);
    evidence.walls.walls.push_back(WallAt(1 + width_m / 4, -2, 0, 2 - width_m / 2));
    const ExploredGrid grid({.near_m = 1.6}, evidence);
    EXPECT_EQ(CellsOf(PossibleFloor(grid, evidence.trail, kClearance_m, 0), grid) > 100, width_m > 1)
        << width_m;
  }
}

TEST(PossibleFloorTest, ARoomBehindAnOpeningIsALargeRegionAndACornerASmallOne) {
  ExploredEvidence evidence = Room(0);
  evidence.walls.walls[0] = WallAt(-1.4, -2, 0, 1.2);
  evidence.walls.walls.push_back(WallAt(1.4, -2, 0, 1.2));
  const ExploredGrid grid({.near_m = 1.6}, evidence);
  PossibleFloor floor(grid, evidence.trail, kClearance_m, 2);
  floor.MeasureRegions();
  const Eigen::Vector2i opening = grid.CellOf({0, -1.5}), corner = grid.CellOf({1.1, 1.1});
  EXPECT_GT(floor.Region_m2(opening), 5);
  EXPECT_GT(floor.Region_m2(opening), floor.Behind_m2(opening)) << "not all of it is in sight";
  EXPECT_LT(floor.Region_m2(corner), 1);
}

TEST(PossibleFloorTest, WhatWasInSightIsNone) {
  ExploredEvidence evidence;
  evidence.trail = {{0, 0}};
  evidence.walls.walls = {WallAt(0, 1, 180, 2)};
  const ExploredGrid grid({.near_m = 1.3}, evidence);
  const PossibleFloor floor(grid, evidence.trail, kClearance_m, 2.0);
  EXPECT_FALSE(floor.Has(grid.CellOf({1.8, 0})));
  EXPECT_TRUE(floor.Has(grid.CellOf({2.2, 0})));
  EXPECT_TRUE(floor.Has(grid.CellOf({0, 1.8}))) << "behind a wall nothing is in sight";
}

TEST(PossibleFloorTest, WhatIsKnownIsNone) {
  const ExploredEvidence evidence = Room(0);
  const ExploredGrid grid({.near_m = 3}, evidence);
  EXPECT_EQ(CellsOf(PossibleFloor(grid, evidence.trail, kClearance_m, 0), grid), 0);
  const PossibleFloor floor(grid, evidence.trail, kClearance_m, 0);
  EXPECT_FALSE(floor.Has({-1, 0}));
}

}  // namespace
}  // namespace priamos::planner
