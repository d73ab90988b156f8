#include "world/core/head/head_motors.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"

namespace priamos::world {
namespace {

void Settle(HeadMotors& dut) {
  for (int i = 0; i < 10000 && dut.moving(); ++i) dut.Step(Duration(2500));
}

TEST(HeadMotorsTest, RestsAtTheDefaultSettingAfterPowerOn) {
  const HeadMotors dut(HeadMotorsConfig{}, Rng(1));
  EXPECT_FALSE(dut.moving());
  EXPECT_EQ(dut.Counters().zoom_step[1], 650);
  EXPECT_EQ(dut.Counters().pan_rad, 0);
}

TEST(HeadMotorsTest, EveryAxisGoesWhereItIsSent) {
  HeadMotors dut(HeadMotorsConfig{}, Rng(1));
  const HeadSetting setting{0.3, -0.2, {-0.05, 0.06}, {700, 800}, {900, 1000}};
  EXPECT_TRUE(dut.Command(setting));
  EXPECT_TRUE(dut.moving());
  Settle(dut);
  const HeadSetting c = dut.Counters();
  EXPECT_NEAR(c.pan_rad, 0.3, 1e-9);
  EXPECT_NEAR(c.tilt_rad, -0.2, 1e-9);
  EXPECT_NEAR(c.vergence_rad[0], -0.05, 1e-9);
  EXPECT_NEAR(c.vergence_rad[1], 0.06, 1e-9);
  EXPECT_EQ(c.zoom_step[0], 700);
  EXPECT_EQ(c.zoom_step[1], 800);
  EXPECT_EQ(c.focus_step[0], 900);
  EXPECT_EQ(c.focus_step[1], 1000);
}

TEST(HeadMotorsTest, TruthDiffersFromTheCountersByThePlay) {
  const HeadMotorsConfig config;
  HeadMotors dut(config, Rng(1));
  dut.Command({0.3, 0, {0, 0}, {650, 650}, {1600, 1600}});
  Settle(dut);
  EXPECT_NEAR(dut.Truth().pan_rad, 0.3 - config.pan.backlash / 2, 5 * config.pan.repeatability);
  EXPECT_NE(dut.Truth().pan_rad, 0.3);
}

TEST(HeadMotorsTest, ACommandThatIsNotFiniteMovesNothing) {
  HeadMotors dut(HeadMotorsConfig{}, Rng(1));
  HeadSetting bad{0.3, 0, {0, 0}, {650, 650}, {1600, 1600}};
  bad.tilt_rad = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(dut.Command(bad));
  EXPECT_FALSE(dut.moving());
}

TEST(HeadMotorsConfigTest, PrintedConfigReadsBack) {
  std::ostringstream printed;
  HeadMotorsConfig config;
  config.pan.backlash = 0.00123;
  PrintConfig(printed, config);
  EXPECT_EQ(ParseConfig<HeadMotorsConfig>("printed", printed.str()).pan.backlash, 0.00123);
}

}  // namespace
}  // namespace priamos::world
