#include "common/ground_plan.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos {
namespace {

using ::testing::HasSubstr;

TEST(GroundPlan, ShippedDoorMapHasTheDoorOfThePaper) {
  const auto dut = LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml");
  const DoorPlan* door = dut.FindDoor(1);
  ASSERT_NE(door, nullptr);
  EXPECT_DOUBLE_EQ(door->opening_width_m, 0.90);
  EXPECT_DOUBLE_EQ(door->opening_height_m, 2.00);
  EXPECT_EQ(dut.walls.size(), 6u);
}

TEST(GroundPlan, ShippedWallsEndAtTheJambs) {
  const auto dut = LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml");
  const Pose2 map_from_door = dut.doors[0].map_from_door();
  const Eigen::Vector2d left = map_from_door * Eigen::Vector2d(0, 0.45);
  const Eigen::Vector2d right = map_from_door * Eigen::Vector2d(0, -0.45);
  EXPECT_NEAR((dut.walls[5].from() - left).norm(), 0, 1e-9);
  EXPECT_NEAR((dut.walls[4].to() - right).norm(), 0, 1e-9);
}

TEST(GroundPlan, UnknownDoorIsNull) {
  EXPECT_EQ(GroundPlan{}.FindDoor(1), nullptr);
}

TEST(GroundPlan, PlanesOfTheEdges) {
  const DoorPlan dut;
  EXPECT_DOUBLE_EQ(dut.FrontX(), -0.085);
  EXPECT_DOUBLE_EQ(dut.StopX(), 0.03);
  EXPECT_DOUBLE_EQ(dut.BackX(), 0.07);
}

std::string ErrorOf(std::string_view text) {
  try {
    ParseConfig<GroundPlan>("plan.toml", text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(GroundPlan, RefusesTwoDoorsWithOneId) {
  EXPECT_THAT(ErrorOf("[[doors]]\nid = 3\n[[doors]]\nid = 3\n"), HasSubstr("every door with its own id"));
}

TEST(GroundPlan, RefusesAWallWithoutLength) {
  EXPECT_THAT(ErrorOf("[[walls]]\nfrom_m = [1, 2]\nto_m = [1, 2]\n"), HasSubstr("plan.toml:3:walls[0].to_m"));
}

TEST(GroundPlan, RefusesARebateThroughTheWholeWall) {
  EXPECT_THAT(ErrorOf("[[doors]]\nwall_thickness_m = 0.1\nrebate_depth_m = 0.1\n"),
              HasSubstr("rebate_depth_m"));
}

TEST(GroundPlan, RefusesALeafHingedAbove) {
  EXPECT_THAT(ErrorOf("[[doors]]\nleaf = \"above\"\n"), HasSubstr("left, right, none or unknown"));
}

TEST(GroundPlan, RefusesACupboardWithTheNumberOfADoor) {
  EXPECT_THAT(ErrorOf("[[doors]]\nid = 3\n[[cupboards]]\nid = 3\n"),
              HasSubstr("every landmark with its own id"));
}

TEST(GroundPlan, AClosedLeafFillsTheRebate) {
  const DoorPlan door;
  const LeafShape dut = LeafOf(door, "left", 0, 0.04);
  EXPECT_NEAR(dut.door_from_leaf.x - dut.size_m.x() / 2, door.StopX(), 1e-9);
  EXPECT_NEAR(dut.door_from_leaf.y, 0, 1e-9);
  EXPECT_LT(dut.size_m.y(), door.opening_width_m + 2 * door.rebate_width_m);
  EXPECT_GT(dut.size_m.y(), door.opening_width_m);
}

TEST(GroundPlan, ALeafOpenByNinetyDegreesLeavesTheOpeningFree) {
  for (const char* hinge : {"left", "right"}) {
    const LeafShape dut = LeafOf(DoorPlan{}, hinge, 90, 0.04);
    EXPECT_NEAR(std::abs(dut.door_from_leaf.yaw), kPi / 2, 1e-9);
    EXPECT_GE(std::abs(dut.door_from_leaf.y) - dut.size_m.x() / 2, 0.45);
    EXPECT_GT(dut.door_from_leaf.x, 0.4);
  }
}

TEST(GroundPlan, PrintedPlanLoadsAgain) {
  const auto plan = LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml");
  std::ostringstream text;
  PrintConfig(text, plan);
  const auto dut = ParseConfig<GroundPlan>("printed", text.str());
  ASSERT_EQ(dut.walls.size(), plan.walls.size());
  EXPECT_EQ(dut.walls[3].from_m, plan.walls[3].from_m);
  EXPECT_DOUBLE_EQ(dut.doors[0].x_m, plan.doors[0].x_m);
}

}  // namespace
}  // namespace priamos
