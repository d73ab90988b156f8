#include "cli/floor/true_floor.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

world::Solid Box(double x_m, double y_m, double length_m, double width_m, double low_m = 0) {
  world::Solid solid;
  solid.map_from_solid = {x_m, y_m, 0};
  solid.size_m = {length_m, width_m};
  solid.z_min_m = low_m;
  solid.z_max_m = 2.5;
  return solid;
}

/// 6 m by 6 m, of which the base covers all but a border of up to 0.2 m (cells), with a wall across it that
/// has a gap of this width.
TrueWorld Room(double gap_m) {
  TrueWorld world;
  const double piece_m = 3 - gap_m / 2;
  world.solids = {Box(3, -0.05, 6.2, 0.1),
                  Box(3, 6.05, 6.2, 0.1),
                  Box(-0.05, 3, 0.1, 6),
                  Box(6.05, 3, 0.1, 6),
                  Box(3, piece_m / 2, 0.2, piece_m),
                  Box(3, 6 - piece_m / 2, 0.2, piece_m)};
  return world;
}

TEST(TrueFloor, TheBaseGetsThroughAGapThatLeavesRoomBesideIt) {
  EXPECT_NEAR(TrueFloor(Room(1.3), {1, 3}).reachable_m2(), 5.6 * 5.6 - 2, 2);
  EXPECT_LT(TrueFloor(Room(0.8), {1, 3}).reachable_m2(), 18);
}

TEST(TrueFloor, SeenIsWhatIsNearAndNotHidden) {
  TrueFloor floor(Room(0), {1, 3});
  EXPECT_EQ(floor.seen(), 0);
  floor.SeeFrom({2.5, 1});
  const double seen = floor.seen();
  EXPECT_GT(seen, 0.1);
  for (const std::size_t cell : floor.CellsSeenFrom({2.5, 1}))
    EXPECT_LT(floor.PlaceOf(int(cell) % floor.nx(), int(cell) / floor.nx()).x(), 3.0);
  floor.SeeFrom({2.5, 1});
  EXPECT_EQ(floor.seen(), seen);
}

TEST(TrueFloor, WhatHangsAboveTheBaseIsNotInItsWay) {
  TrueWorld world = Room(1.3);
  world.solids.push_back(Box(3, 3, 0.1, 1.3, 2.2));
  EXPECT_NEAR(TrueFloor(world, {1, 3}).reachable_m2(), TrueFloor(Room(1.3), {1, 3}).reachable_m2(), 1e-9);
}

}  // namespace
}  // namespace priamos::cli
