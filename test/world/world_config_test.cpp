#include "world/world_config.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::world {
namespace {

TEST(WorldConfigTest, TheShippedFileLoads) {
  const auto dut = LoadConfig<WorldConfig>(std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/world.toml");
  EXPECT_EQ(dut.world, "worlds/door.toml");
  EXPECT_NEAR(dut.robot.base.half_wheelbase_m + dut.robot.base.half_track_m, 0.62, 1e-12);
}

TEST(WorldConfigTest, PrintedConfigReadsBack) {
  WorldConfig config;
  config.robot.sonar.crosstalk = 0.0123;
  config.robot.sonar.materials.resize(2);
  config.robot.drive.ticks_per_turn = 1000;
  std::ostringstream printed;
  PrintConfig(printed, config);
  const auto dut = ParseConfig<WorldConfig>("printed", printed.str());
  EXPECT_EQ(dut.robot.sonar.crosstalk, 0.0123);
  EXPECT_EQ(dut.robot.sonar.materials.size(), 2u);
  EXPECT_EQ(dut.robot.drive.ticks_per_turn, 1000);
  EXPECT_EQ(dut.robot.head_motors.pan.backlash, config.robot.head_motors.pan.backlash);
}

TEST(WorldConfigTest, EachLaserHasItsPlane) {
  EXPECT_EQ(WorldConfig{}.lasers.size(), 2U) << "as shipped";
  const auto dut = ParseConfig<WorldConfig>(
      "world.toml",
      "[[lasers]]\npitch_rad = 0.4\n[[lasers]]\npitch_rad = 0.3\n[[lasers]]\npitch_rad = 0.2\n");
  ASSERT_EQ(dut.lasers.size(), 3U);
  EXPECT_EQ(dut.lasers[2].pitch_rad, 0.2);
  std::string five;
  for (int i = 0; i < 5; ++i) five += "[[lasers]]\n";
  EXPECT_THAT(support::ThrownReason([&] { ParseConfig<WorldConfig>("world.toml", five); }),
              testing::HasSubstr("1 to 4 line lasers, a table [[lasers]] for each"));
}

TEST(WorldConfigTest, SpecimenZeroTakesTheWrittenHead) {
  WorldConfig config;
  config.head_specimen = 0;
  config.head.x_m = 0.3;
  EXPECT_EQ(config.BuiltHead().x_m, 0.3);
  config.head_specimen = 4;
  EXPECT_NE(config.BuiltHead().x_m, 0.3);
  EXPECT_EQ(config.BuiltHead().cameras[0].focal_min_px, config.BuiltHead().cameras[0].focal_min_px);
}

}  // namespace
}  // namespace priamos::world
