#include "teleop/teleop_config.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos::teleop {
namespace {

TEST(TeleopConfig, ShippedFilesLoad) {
  for (const char* file : {"/config/sim/teleop.toml", "/config/robot/teleop.toml"})
    EXPECT_NO_THROW(LoadConfig<TeleopConfig>(std::string(PRIAMOS_SOURCE_DIR) + file)) << file;
}

TEST(TeleopConfig, PrintedConfigurationLoadsAgain) {
  TeleopConfig config;
  config.pilot.base.vx.inverted = true;
  config.joystick.axis_codes[2] = 5;
  std::ostringstream text;
  PrintConfig(text, config);
  const auto dut = ParseConfig<TeleopConfig>("printed", text.str());
  EXPECT_TRUE(dut.pilot.base.vx.inverted);
  EXPECT_EQ(dut.joystick.axis_codes[2], 5);
}

TEST(TeleopConfig, AnAxisThatDoesNotExistIsRefused) {
  EXPECT_THROW(ParseConfig<TeleopConfig>("x", "[pilot.base.vx]\naxis = \"sideways\"\n"), ConfigError);
}

}  // namespace
}  // namespace priamos::teleop
