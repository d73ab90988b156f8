#include "planner/core/explore/grid_ways.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// A floor driven over from 0 to 6 along y = 0 and y = 1.
ExploredEvidence Floor() {
  ExploredEvidence evidence;
  for (double x = 0; x <= 6; x += 0.2)
    for (const double y : {0.0, 1.0}) evidence.trail.push_back({x, y});
  return evidence;
}

TEST(GridWaysTest, AFreeWayIsAsLongAsTheCellsHaveIt) {
  const ExploredGrid grid({}, Floor());
  const GridWays dut(grid, {0, 0}, 0.44);
  EXPECT_NEAR(dut.Way_m(grid.CellOf({5, 0})), 5, 0.11);
  EXPECT_NEAR(dut.Way_m(grid.CellOf({1, 1})), std::sqrt(2), 0.15);
}

TEST(GridWaysTest, NoWayLeadsOverTheUnknownOrTooNearToWhatIsClosed) {
  ExploredEvidence evidence = Floor();
  evidence.things = {{{3, 1.6, 0}, {0.1, 1.15}}};  // free below y = 0.45
  const ExploredGrid grid({}, evidence);
  const GridWays slim(grid, {0, 0}, 0.3), wide(grid, {0, 0}, 1.9);
  EXPECT_TRUE(std::isfinite(slim.Way_m(grid.CellOf({5, 0}))));
  EXPECT_TRUE(std::isinf(wide.Way_m(grid.CellOf({5, 0}))));
  EXPECT_TRUE(std::isinf(slim.Way_m(grid.CellOf({5, 3.2}))));
}

TEST(GridWaysTest, ClearanceIsTheDistanceToWhatIsClosed) {
  ExploredEvidence evidence = Floor();
  evidence.walls.walls = {WallAt(3, -0.8, 0, 8)};
  const ExploredGrid grid({}, evidence);
  const GridWays dut(grid, {0, 0}, 0.44);
  EXPECT_NEAR(dut.Clearance_m(grid.CellOf({3, 0.2})), 1.0, 0.11);
  EXPECT_EQ(GridWays(ExploredGrid({}, Floor()), {0, 0}, 0.44).Clearance_m(grid.CellOf({3, 0})), 3);
}

TEST(GridWaysTest, EdgesAreKeptOffToTheCentimetre) {
  ExploredEvidence evidence = Floor();
  evidence.edges = {{3.03, 0.02}, {3.03, 1.07}};  // 1.05 m apart
  const ExploredGrid grid({}, evidence);
  const Eigen::Vector2i between = grid.CellOf({3.03, 0.54}), beside = grid.CellOf({3.03, 0.2});
  const GridWays dut(grid, {0, 0}, 0.44);
  EXPECT_GE(dut.Clearance_m(between), 0.44);
  EXPECT_NEAR(dut.Clearance_m(beside), 0.2, 0.08);
  EXPECT_TRUE(std::isfinite(dut.Way_m(grid.CellOf({5, 0.5}))));
}

TEST(GridWaysTest, ABaseThatStandsTooNearMayLeave) {
  ExploredEvidence evidence = Floor();
  evidence.things = {{{0, -0.6, 0}, {0.3, 0.2}}};
  const ExploredGrid grid({}, evidence);
  EXPECT_TRUE(std::isfinite(GridWays(grid, {0, 0}, 0.6).Way_m(grid.CellOf({4, 0.5}))));
}

}  // namespace
}  // namespace priamos::planner
