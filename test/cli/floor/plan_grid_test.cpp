#include "cli/floor/plan_grid.hpp"

#include <gtest/gtest.h>

#include "common/config.hpp"
#include "world/core/scene/occupancy_grid.hpp"

namespace priamos::cli {
namespace {

/// The grid as the simulated world reads it.
world::OccupancyGrid ReadBack(const PlanGrid& grid) {
  return world::ParseGrid(world::ParseGridHeader("map.yaml", ToYaml(grid, "map.pgm")), "map.pgm",
                          ToPgm(grid));
}

bool IsTaken(const world::OccupancyGrid& grid, double x_m, double y_m) {
  const Eigen::Vector2d at = grid.header.map_from_grid.Inverse() * Eigen::Vector2d(x_m, y_m);
  return grid.At(static_cast<int>(at.x() / grid.header.resolution_m),
                 static_cast<int>(at.y() / grid.header.resolution_m));
}

TEST(PlanGrid, WallsCupboardsAndNoGoAreasAreTakenTheRestIsFree) {
  GroundPlan plan = LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml");
  plan.no_go.push_back({"stairs", 3, 1, 0, 1, 1});
  CupboardPlan cupboard;
  cupboard.x_m = 8;
  cupboard.y_m = 1;
  plan.cupboards.push_back(cupboard);
  const auto dut = ReadBack(GridOf(plan, 0.05));
  EXPECT_EQ(dut.width, 226);  // from -0.14 to 10.14 m, and half a metre around
  for (const WallPlan& wall : plan.walls)
    for (const double part : {0.01, 0.5, 0.99}) {
      const Eigen::Vector2d at = wall.from() + part * (wall.to() - wall.from());
      EXPECT_TRUE(IsTaken(dut, at.x(), at.y())) << wall.name << " " << part;
    }
  EXPECT_TRUE(IsTaken(dut, 3.4, 1.4));
  EXPECT_TRUE(IsTaken(dut, 8.2, 1.2));
  EXPECT_FALSE(IsTaken(dut, 2, 2.4));
  EXPECT_FALSE(IsTaken(dut, 6, 2.4)) << "the opening of the door";
  EXPECT_FALSE(IsTaken(dut, 3.6, 1.4));
}

TEST(PlanGrid, APlanWithoutAWallIsRefused) {
  EXPECT_THROW(GridOf(GroundPlan{}, 0.05), ConfigError);
}

}  // namespace
}  // namespace priamos::cli
