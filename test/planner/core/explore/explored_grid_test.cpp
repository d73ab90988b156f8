#include "planner/core/explore/explored_grid.hpp"

#include <gtest/gtest.h>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;
using Eigen::Vector2d;

const ExploredGridConfig kConfig{.near_m = 1.3, .wall_reach_m = 3, .facing_deg = 40};

TEST(ExploredGridTest, WithoutEvidenceNothingIsKnown) {
  const ExploredGrid dut(kConfig, {});
  EXPECT_EQ(dut.cells(), 0U);
  EXPECT_EQ(dut.At(Vector2d(0, 0)), Cell::kUnknown);
  EXPECT_EQ(dut.free_m2(), 0);
}

TEST(ExploredGridTest, WhatIsNearToTheBaseIsFree) {
  const ExploredGrid dut(kConfig, {{{5, -3}}, {}, {}});
  EXPECT_EQ(dut.At(Vector2d(5, -3)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(6.2, -3)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(5, -4.2)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(6.5, -3)), Cell::kUnknown);
  EXPECT_NEAR(dut.free_m2(), kPi * 1.3 * 1.3, 0.5);
}

TEST(ExploredGridTest, AWallEndsWhatIsNear) {
  const ExploredGrid dut(kConfig, {{{0, 0}}, {1, 1, {WallAt(0, -0.8, 0, 4)}, {}}, {}});
  EXPECT_EQ(dut.At(Vector2d(0, -0.6)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(0, -0.85)), Cell::kClosed);
  EXPECT_EQ(dut.At(Vector2d(0, -1.1)), Cell::kUnknown);
  EXPECT_EQ(dut.At(Vector2d(0.4, -1.1)), Cell::kUnknown);
}

TEST(ExploredGridTest, BeforeAWallThatFacesTheBaseItIsFree) {
  const ExploredGrid dut(kConfig, {{{0, 0}}, {1, 1, {WallAt(0, -2.5, 0, 2)}, {}}, {}});
  EXPECT_EQ(dut.At(Vector2d(0, -2.3)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(0.8, -2.3)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(2, -2.3)), Cell::kUnknown) << "not before the wall";
  const ExploredGrid behind(kConfig, {{{0, 0}}, {1, 1, {WallAt(0, -2.5, 180, 2)}, {}}, {}});
  EXPECT_EQ(behind.At(Vector2d(0, -2.3)), Cell::kUnknown) << "the wall was heard from the other side";
  const ExploredGrid far(kConfig, {{{0, 0}}, {1, 1, {WallAt(0, -3.5, 0, 2)}, {}}, {}});
  EXPECT_EQ(far.At(Vector2d(0, -3.3)), Cell::kUnknown);
}

TEST(ExploredGridTest, AThingIsClosedAndHidesWhatIsBehindIt) {
  const ExploredGrid dut(kConfig, {{{0, 0}}, {}, {{{0.9, 0, 0}, {0.15, 0.3}}}});
  EXPECT_EQ(dut.At(Vector2d(0.9, 0)), Cell::kClosed);
  EXPECT_EQ(dut.At(Vector2d(1.2, 0)), Cell::kUnknown);
  EXPECT_EQ(dut.At(Vector2d(-1.2, 0)), Cell::kFree);
}

TEST(ExploredGridTest, WhatTheHeadSawIsClosedLikewise) {
  const ExploredGrid dut(kConfig, {{{0, 0}}, {}, {}, {{{0.9, 0, 0}, {0.15, 0.3}}}});
  EXPECT_EQ(dut.At(Vector2d(0.9, 0)), Cell::kClosed);
  EXPECT_EQ(dut.At(Vector2d(1.2, 0)), Cell::kUnknown);
}

TEST(ExploredGridTest, WhereTheBaseWasNothingIs) {
  const ExploredGrid dut(kConfig, {{{0, 0}, {1, 0}}, {1, 1, {WallAt(0.5, 0, 90, 2)}, {}}, {}});
  EXPECT_EQ(dut.At(Vector2d(0.75, 0.05)), Cell::kFree);
  EXPECT_EQ(dut.At(Vector2d(0.55, 0.6)), Cell::kClosed);
}

TEST(ExploredGridTest, CellsAndPlacesBelongTogether) {
  const ExploredGrid dut(kConfig, {{{-7.3, 2.2}}, {}, {}});
  const Eigen::Vector2i cell = dut.CellOf({-7.0, 2.0});
  EXPECT_LE((dut.PlaceOf(cell.x(), cell.y()) - Vector2d(-7.0, 2.0)).norm(), 0.071);
  EXPECT_FALSE(dut.Holds(-1, 0));
  EXPECT_EQ(dut.At(-1, 0), Cell::kUnknown);
}

TEST(ExploredGridTest, TheEndsOfAWallAreDoubtedAndStillHideWhatIsBehindThem) {
  LearnedWall wall = WallAt(0, 1, 180, 2);
  wall.sigma_end_m = 0.2;
  ExploredEvidence evidence;
  evidence.trail = {{0, 0}};
  evidence.walls = {1, 1, {wall}, {}};
  const ExploredGrid grid({.near_m = 2.5}, evidence);
  using Cell = ExploredGrid::Cell;
  EXPECT_EQ(grid.At(Eigen::Vector2d(0.5, 1.05)), Cell::kClosed);
  EXPECT_EQ(grid.At(Eigen::Vector2d(0.95, 1.05)), Cell::kDoubtful);
  EXPECT_EQ(grid.At(Eigen::Vector2d(0, 1.6)), Cell::kUnknown);
  EXPECT_EQ(grid.At(Eigen::Vector2d(1.3, 1.45)), Cell::kUnknown);
}

}  // namespace
}  // namespace priamos::planner
