#include "head/core/motion/ahead_watch.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

TEST(AheadWatch, LooksAheadWhileTheBaseDrivesIfItIsToldTo) {
  const Time now = FromUtime(1'000'000'000);
  EXPECT_FALSE(AheadWatch(AheadWatchConfig{}).Step(false, false, true, now));
  AheadWatchConfig config;
  config.ahead = true;
  AheadWatch dut(config);
  EXPECT_FALSE(dut.Step(false, false, false, now)) << "it stands";
  EXPECT_TRUE(dut.Step(false, false, true, now));
}

TEST(AheadWatch, TheSettingKeepsAllButPanAndTilt) {
  const HeadSetting base{0.1, 0.2, {-0.02, 0.02}, {650, 600}, {1600, 1500}};
  const HeadSetting setting = AheadWatch({}).SettingFrom(base, Radians(-20));
  EXPECT_EQ(setting.pan_rad, Radians(-20)) << "to where the base drives";
  EXPECT_EQ(AheadWatch({}).SettingFrom(base, 3).pan_rad, Radians(AheadWatchConfig{}.max_pan_deg));
  EXPECT_EQ(setting.tilt_rad, Radians(AheadWatchConfig{}.tilt_deg));
  EXPECT_EQ(setting.zoom_step, base.zoom_step);
  EXPECT_EQ(setting.focus_step, base.focus_step);
  EXPECT_EQ(setting.vergence_rad, base.vergence_rad);
}

}  // namespace
}  // namespace priamos::head
