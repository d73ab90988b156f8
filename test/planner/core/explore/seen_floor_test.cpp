#include "planner/core/explore/seen_floor.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace priamos::planner {
namespace {

/// A base that stood at the origin, in the open.
ExploredGrid AroundTheOrigin(std::vector<Rectangle> things = {}) {
  return ExploredGrid({}, {{{0, 0}, {0.2, 0}}, {}, std::move(things)});
}

double FreeArea(const SeenFloor& seen) {
  const int cells = std::accumulate(seen.free.begin(), seen.free.end(), 0,
                                    [](int n, const SeenFloor::Run& run) { return n + run.length; });
  return cells * SeenFloor::kCell_m * SeenFloor::kCell_m;
}

bool Holds(const SeenFloor& seen, const Eigen::Vector2d& at) {
  const Eigen::Vector2d cell = (at - seen.corner) / SeenFloor::kCell_m;
  for (const SeenFloor::Run& run : seen.free)
    if (int(cell.y()) == run.row && cell.x() >= run.first && cell.x() < run.first + run.length) return true;
  return false;
}

TEST(SeenFloor, HasTheAreaThatWasSeen) {
  const ExploredGrid grid = AroundTheOrigin();
  const SeenFloor seen = SeenFloorOf(grid, 0.6, {});
  EXPECT_NEAR(FreeArea(seen), grid.free_m2(), 0.25 * grid.free_m2()) << "cells at the border count whole";
  EXPECT_TRUE(Holds(seen, {0, 0}));
  EXPECT_TRUE(Holds(seen, {1, 0.3}));
  EXPECT_FALSE(Holds(seen, {3, 0}));
}

TEST(SeenFloor, LeavesOutWhatIsClosed) {
  const SeenFloor seen = SeenFloorOf(AroundTheOrigin({{{0.9, 0, 0}, {0.2, 0.2}}}), 0.6, {});
  EXPECT_FALSE(Holds(seen, {0.9, 0}));
  EXPECT_TRUE(Holds(seen, {-0.9, 0}));
}

TEST(SeenFloor, NamesItsEdgesAndThoseThatAreLeft) {
  const ExploredGrid grid = AroundTheOrigin();
  const SeenFloor seen = SeenFloorOf(grid, 0.6, {});
  ASSERT_FALSE(seen.edges.empty());
  EXPECT_FALSE(seen.edges.front().left);
  const auto left = SeenFloorOf(grid, 0.6, {{seen.edges.front().middle, 1, "shut"}});
  EXPECT_TRUE(left.edges.front().left);
}

}  // namespace
}  // namespace priamos::planner
