#include "planner/planner_config.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

std::string ErrorOf(std::string_view text) {
  try {
    ParseConfig<PlannerConfig>("planner.toml", text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(PlannerConfig, ShippedFileLoadsAndKeepsThePaperFootprint) {
  const auto dut = LoadConfig<PlannerConfig>(std::string(PRIAMOS_SOURCE_DIR "/config/sim/planner.toml"));
  EXPECT_DOUBLE_EQ(dut.footprint.width_m, 0.78);
  EXPECT_EQ(dut.map, "maps/door.toml");
}

TEST(PlannerConfig, PrintedConfigurationLoadsAgain) {
  PlannerConfig config;
  config.mission.look.failures = 7;
  config.passage.hold_m = 0.7;
  std::ostringstream text;
  PrintConfig(text, config);
  const auto dut = ParseConfig<PlannerConfig>("printed", text.str());
  EXPECT_EQ(dut.mission.look.failures, 7);
  EXPECT_DOUBLE_EQ(dut.passage.hold_m, 0.7);
}

TEST(PlannerConfig, UnknownKeyIsNamedWithItsLine) {
  EXPECT_THAT(ErrorOf("[mission]\nspeed = 1\n"), HasSubstr("planner.toml:2:mission.speed"));
}

TEST(PlannerConfig, LookingFartherThanStartingToLookIsRefused) {
  EXPECT_THAT(ErrorOf("[mission]\nlook_from_m = 2\nlook_to_m = 3\n"), HasSubstr("at most look_from_m"));
}

TEST(PlannerConfig, SlowestAboveSpeedIsRefused) {
  EXPECT_THAT(ErrorOf("[mission]\nspeed_m_s = 0.1\nslowest_m_s = 0.2\n"), HasSubstr("at most speed_m_s"));
}

TEST(PlannerConfig, AligningNearerThanPossibleIsRefused) {
  EXPECT_THAT(ErrorOf("[passage]\nalign_m = 1\nalign_least_m = 1.2\n"), HasSubstr("at most align_m"));
}

}  // namespace
}  // namespace priamos::planner
