#include "planner/floor_report.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

LearnedWalls Walls(int n) {
  LearnedWalls walls;
  for (int i = 0; i < n; ++i) {
    LearnedWall wall;
    wall.x_m = i;
    wall.length_m = 2;
    walls.walls.push_back(wall);
  }
  return walls;
}

TEST(FloorParts, AnEmptyMapIsOneMessage) {
  const auto parts = FloorParts({}, std::nullopt, 3, FromUtime(5));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].revision, 3);
  EXPECT_EQ(parts[0].n_parts, 1);
  EXPECT_EQ(parts[0].utime, 5);
  EXPECT_EQ(parts[0].n_walls, 0);
}

TEST(FloorParts, AWallIsALineFromItsBeginToItsEnd) {
  const auto parts = FloorParts(Walls(2), std::nullopt, 1, {});
  ASSERT_EQ(parts[0].n_walls, 2);
  EXPECT_FLOAT_EQ(parts[0].walls[1].x1_m, 0);
  EXPECT_FLOAT_EQ(parts[0].walls[1].x2_m, 2);
}

TEST(FloorParts, NothingIsLostOrTwiceInManyParts) {
  SeenFloor seen;
  for (int i = 0; i < 350; ++i) seen.free.push_back({i, i, 1 + i});
  seen.edges = {{{1, 2}, 3, true}};
  const auto parts = FloorParts(Walls(60), seen, 1, {});
  ASSERT_EQ(parts.size(), 4u);
  std::size_t walls = 0;
  std::vector<int> rows;
  for (const floor_map_t& part : parts) {
    EXPECT_EQ(part.n_parts, 4);
    walls += part.walls.size();
    for (const floor_run_t& run : part.runs) rows.push_back(run.row);
    EXPECT_LE(part.getEncodedSize(), 1400);
  }
  EXPECT_EQ(walls, 60u);
  ASSERT_EQ(rows.size(), 350u);
  for (int i = 0; i < 350; ++i) EXPECT_EQ(rows[std::size_t(i)], i);
  EXPECT_TRUE(parts[0].frontiers.at(0).left);
}

TEST(FloorParts, WhatIsTooLargeForAHundredMessagesIsLeftOut) {
  EXPECT_EQ(FloorParts(Walls(5000), std::nullopt, 1, {}).size(), 100u);
}

}  // namespace
}  // namespace priamos::planner
