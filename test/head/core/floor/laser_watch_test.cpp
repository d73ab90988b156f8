#include "head/core/floor/laser_watch.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"
#include "head/core/camera/head_model.hpp"
#include "test/support/laser_floor.hpp"

namespace priamos::head {
namespace {

using Action = LaserWatch::Action;

LaserWatchConfig TwicePerSecond() {
  LaserWatchConfig config;
  config.rate_hz = 2;
  config.idle_s = 1;
  return config;
}

class LaserWatchTest : public testing::Test {
 protected:
  Time At(double s) const { return FromUtime(1'000'000'000) + FromSeconds(s); }
  static FrameNotice Frame(std::int32_t id, int camera = 2) {
    FrameNotice frame;
    frame.frame_id = id;
    frame.camera = camera;
    return frame;
  }
  LaserWatch dut_{TwicePerSecond()};
};

TEST_F(LaserWatchTest, SwitchedOffItLeavesTheHeadAlone) {
  LaserWatch off{LaserWatchConfig{}};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(off.Step(false, false, At(0.1 * i)), Action::kWait);
}

TEST_F(LaserWatchTest, TurnsDownOnlyWhenNobodyHasNeededTheHeadForAWhile) {
  EXPECT_EQ(dut_.Step(true, false, At(0)), Action::kWait);
  EXPECT_EQ(dut_.Step(false, false, At(0.1)), Action::kWait);
  EXPECT_EQ(dut_.Step(false, false, At(1.05)), Action::kWait);
  EXPECT_EQ(dut_.Step(false, false, At(1.15)), Action::kLower);
  EXPECT_EQ(dut_.Step(false, false, At(1.2)), Action::kWait) << "once is enough";
  EXPECT_EQ(dut_.Step(true, false, At(1.3)), Action::kWait);
  EXPECT_EQ(dut_.Step(false, false, At(1.4)), Action::kWait) << "a look begins the wait anew";
}

TEST_F(LaserWatchTest, AHeadThatDoesNotComeDownIsToldAgain) {
  dut_.Step(false, false, At(0));
  EXPECT_EQ(dut_.Step(false, false, At(1.1)), Action::kLower);
  EXPECT_EQ(dut_.Step(false, false, At(6.0)), Action::kWait);
  EXPECT_EQ(dut_.Step(false, false, At(6.2)), Action::kLower);
}

TEST_F(LaserWatchTest, TakesPicturesAtItsRateAndEachOnce) {
  dut_.Step(false, true, At(0));
  ASSERT_EQ(dut_.Step(false, true, At(1.1)), Action::kTrigger);
  const auto first = dut_.frame_id();
  EXPECT_EQ(dut_.Step(false, true, At(1.5)), Action::kWait);
  EXPECT_FALSE(dut_.Takes(Frame(first, 0))) << "another camera's";
  EXPECT_FALSE(dut_.Takes(Frame(first - 1)));
  EXPECT_TRUE(dut_.Takes(Frame(first)));
  EXPECT_FALSE(dut_.Takes(Frame(first)));
  ASSERT_EQ(dut_.Step(false, true, At(1.7)), Action::kTrigger);
  EXPECT_NE(dut_.frame_id(), first);
}

TEST_F(LaserWatchTest, ItsPicturesNeverHaveTheNumberOfALook) {
  dut_.Step(false, true, At(0));
  for (int i = 0; i < 0x10002; ++i) {
    ASSERT_EQ(dut_.Step(false, true, At(1 + i)), Action::kTrigger);
    ASSERT_GE(dut_.frame_id(), 0x40000000);
    ASSERT_LE(dut_.frame_id(), 0x4000FFFF);
  }
}

TEST_F(LaserWatchTest, APictureOfAHeadThatHasMovedIsNotTaken) {
  dut_.Step(false, true, At(0));
  ASSERT_EQ(dut_.Step(false, true, At(1.1)), Action::kTrigger);
  dut_.Step(true, true, At(1.12));
  EXPECT_FALSE(dut_.Takes(Frame(dut_.frame_id())));
}

TEST(SeesLineTest, OnlyACameraThatLooksDownDoes) {
  const support::LaserFloor scene = support::NominalLaserFloor();
  EXPECT_TRUE(SeesLine(scene.camera, scene.laser, 768, 576));
  HeadSetting level;
  const CameraModel up = MakeCameraModel({900, {383.5, 287.5}, -0.05, 0, 0.02},
                                         HeadGeometry().BaseFromCamera(level, kThird, 0.02));
  EXPECT_FALSE(SeesLine(up, scene.laser, 768, 576));
}

TEST(SeesLineTest, TheLineIsNotNearTheUpperOrLowerBorder) {
  HeadModel head;
  head.lenses[kThird] = LensTable({0}, {0}, {LensState{900, {383.5, 287.5}, -0.05, 0, 0.02}});
  head.laser = support::NominalLaserFloor().laser;
  const Eigen::Vector3d line_ahead(-head.laser->offset_m / head.laser->normal.x(), 0, 0);
  int above = 0, below = 0;
  for (double tilt_deg = 20; tilt_deg < 60; tilt_deg += 0.25) {
    const HeadSetting setting{.tilt_rad = Radians(tilt_deg)};
    const double row = head.CameraAt(setting, kThird)->Project(line_ahead).y() / 576;
    EXPECT_EQ(SeesLine(head, setting), row > 0.15 && row < 0.85) << tilt_deg << " deg, row " << row;
    above += row > 0 && row < 0.15;
    below += row > 0.85 && row < 1;
  }
  EXPECT_GT(above, 5);
  EXPECT_GT(below, 5);
}

TEST(SeesLineTest, AHeadDoesWithItsThirdCameraAndAKnownLaser) {
  HeadModel head;
  head.lenses[kThird] = LensTable({0}, {0}, {LensState{900, {383.5, 287.5}, -0.05, 0, 0.02}});
  const HeadSetting down{.tilt_rad = Radians(36)};
  EXPECT_FALSE(SeesLine(head, down)) << "no laser is calibrated";
  head.laser = support::NominalLaserFloor().laser;
  EXPECT_TRUE(SeesLine(head, down));
  EXPECT_FALSE(SeesLine(head, HeadSetting{}));
}

}  // namespace
}  // namespace priamos::head
