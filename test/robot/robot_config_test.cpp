#include "robot/robot_config.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos::robot {
namespace {

using testing::HasSubstr;

std::string ErrorOf(std::string_view text) {
  try {
    ParseConfig<RobotConfig>("robot.toml", text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotConfig, ShippedFilesLoadAndKeepThePaperFootprint) {
  for (const char* file : {"/config/sim/robot.toml", "/config/robot/robot.toml"}) {
    const auto dut = LoadConfig<RobotConfig>(std::string(PRIAMOS_SOURCE_DIR) + file);
    EXPECT_DOUBLE_EQ(dut.drive.footprint.width_m, 0.78) << file;
    EXPECT_DOUBLE_EQ(dut.drive.footprint.length_m, 0.95) << file;
  }
}

TEST(RobotConfig, PrintedConfigurationLoadsAgain) {
  RobotConfig config;
  config.base.lever_m = 0.7;
  config.drive.collision.gap_m = 0.11;
  config.localiser.estimator.initial.yaw_deg = 90;
  std::ostringstream text;
  PrintConfig(text, config);
  const auto dut = ParseConfig<RobotConfig>("printed", text.str());
  EXPECT_DOUBLE_EQ(dut.base.lever_m, 0.7);
  EXPECT_DOUBLE_EQ(dut.drive.collision.gap_m, 0.11);
  EXPECT_DOUBLE_EQ(dut.localiser.estimator.initial.yaw_deg, 90);
}

TEST(RobotConfig, UnknownKeyIsNamedWithItsLine) {
  EXPECT_THAT(ErrorOf("[base]\nradius = 1\n"), HasSubstr("robot.toml:2:base.radius"));
}

TEST(RobotConfig, AWheelWithoutRadiusIsRefused) {
  EXPECT_THAT(ErrorOf("[base]\nwheel_radius_m = 0\n"), HasSubstr("robot.toml:2:base.wheel_radius_m"));
}

}  // namespace
}  // namespace priamos::robot
