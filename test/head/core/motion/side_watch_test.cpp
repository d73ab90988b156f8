#include "head/core/motion/side_watch.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

SideWatchConfig On() {
  SideWatchConfig config;
  config.corridors = true;
  config.every_s = 0.2;
  config.idle_s = 2;
  return config;
}

TEST(SideWatch, SwitchedOffItLeavesTheHeadAlone) {
  SideWatch dut{SideWatchConfig{}};
  EXPECT_FALSE(dut.Step(false, false, true, At(0)));
}

TEST(SideWatch, GlancesToBothSidesInTurn) {
  SideWatch dut(On());
  const auto first = dut.Step(false, false, true, At(0));
  ASSERT_TRUE(first);
  EXPECT_FALSE(dut.Step(false, true, true, At(0.5))) << "one at a time";
  EXPECT_FALSE(dut.Step(false, false, true, At(0.6)));
  const auto second = dut.Step(false, false, true, At(0.75));
  ASSERT_TRUE(second);
  EXPECT_DOUBLE_EQ(*first, -*second);
  EXPECT_DOUBLE_EQ(std::abs(*first), Radians(On().pan_deg));
}

TEST(SideWatch, WhereNoCorridorIsFollowedItDoesNot) {
  SideWatch dut(On());
  EXPECT_FALSE(dut.Step(false, false, false, At(0)));
}

TEST(SideWatch, WhoNeedsTheHeadHasItForAWhile) {
  SideWatch dut(On());
  EXPECT_FALSE(dut.Step(true, false, true, At(0)));
  EXPECT_FALSE(dut.Step(false, false, true, At(1.9)));
  EXPECT_TRUE(dut.Step(false, false, true, At(2.1)));
}

TEST(SideWatch, TheSettingKeepsVergenceAndFocus) {
  const SideWatch dut(On());
  const HeadSetting base{0.1, 0.2, {-0.02, 0.02}, {650, 650}, {1600, 1500}};
  const HeadSetting setting = dut.SettingAt(0.5, base);
  EXPECT_EQ(setting.pan_rad, 0.5);
  EXPECT_EQ(setting.tilt_rad, Radians(On().tilt_deg));
  EXPECT_EQ(setting.zoom_step[1], On().zoom_step);
  EXPECT_EQ(setting.focus_step, base.focus_step);
  EXPECT_EQ(setting.vergence_rad, base.vergence_rad);
}

}  // namespace
}  // namespace priamos::head
