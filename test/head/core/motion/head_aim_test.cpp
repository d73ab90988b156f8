#include "head/core/motion/head_aim.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "common/robot/robot_drawing.hpp"

namespace priamos::head {
namespace {

constexpr Time kNow = FromUtime(1'000'000'000);

HeadSetting Here() {
  HeadSetting here;
  here.pan_rad = 0.1;
  here.vergence_rad = {-0.05, 0.05};
  here.zoom_step = here.focus_step = {700, 700};
  return here;
}

HeadAim Aim(Time time, double pan_rad = 0, double tilt_rad = 0) {
  HeadAim aim;
  aim.time = time;
  aim.pan_rad = pan_rad;
  aim.tilt_rad = tilt_rad;
  return aim;
}

TEST(AimKeeper, PointsTheHeadOnceAndLeavesTheRestAsItIs) {
  AimKeeper dut;
  ASSERT_TRUE(dut.Take(Aim(kNow, 0.5, -0.2), kNow));
  const auto setting = dut.Next(Here(), kNow);
  ASSERT_TRUE(setting);
  EXPECT_EQ(setting->pan_rad, 0.5);
  EXPECT_EQ(setting->tilt_rad, -0.2);
  EXPECT_EQ(setting->vergence_rad, Here().vergence_rad);
  EXPECT_EQ(setting->zoom_step, Here().zoom_step);
  EXPECT_FALSE(dut.Next(Here(), kNow)) << "once";
  EXPECT_TRUE(dut.IsHeld(kNow + std::chrono::seconds(9)));
  EXPECT_FALSE(dut.IsHeld(kNow + std::chrono::seconds(10)));
}

TEST(AimKeeper, BothCamerasConvergeAndZoomAlike) {
  AimKeeper dut;
  HeadAim aim = Aim(kNow);
  aim.vergence_rad = 0.1;
  aim.zoom_step = 300;
  aim.focus_step = 400;
  dut.Take(aim, kNow);
  const auto setting = dut.Next(Here(), kNow);
  EXPECT_EQ(setting->vergence_rad, (std::array<double, 2>{-0.1, 0.1}));
  EXPECT_EQ(setting->zoom_step, (std::array<int, 2>{300, 300}));
  EXPECT_EQ(setting->focus_step, (std::array<int, 2>{400, 400}));
}

TEST(AimKeeper, StaysWithinWhatTheMotorsReach) {
  AimKeeper dut;
  HeadAim aim = Aim(kNow, 9, -9);
  aim.zoom_step = 99999;
  dut.Take(aim, kNow);
  const auto setting = dut.Next(Here(), kNow);
  EXPECT_EQ(setting->pan_rad, kDrawnHead.most_pan_rad);
  EXPECT_EQ(setting->tilt_rad, -kDrawnHead.most_tilt_rad);
  EXPECT_EQ(setting->zoom_step[0], kDrawnHead.most_step);
}

TEST(AimKeeper, RefusesWhatIsOldOrNoNumber) {
  AimKeeper dut;
  EXPECT_FALSE(dut.Take(Aim(kNow - std::chrono::milliseconds(3001)), kNow));
  EXPECT_FALSE(dut.Take(Aim(kNow, std::numeric_limits<double>::quiet_NaN()), kNow));
  EXPECT_TRUE(dut.Take(Aim(kNow), kNow));
  EXPECT_FALSE(dut.Take(Aim(kNow), kNow)) << "said again";
  EXPECT_FALSE(dut.Take(Aim(kNow - std::chrono::seconds(1)), kNow)) << "overtaken";
  EXPECT_EQ(dut.refused(), 3);
}

TEST(AimKeeper, AnAimThatWaitedForALookTooLongIsForgotten) {
  AimKeeper dut;
  dut.Take(Aim(kNow), kNow);
  EXPECT_FALSE(dut.Next(Here(), kNow + std::chrono::seconds(4)));
}

}  // namespace
}  // namespace priamos::head
