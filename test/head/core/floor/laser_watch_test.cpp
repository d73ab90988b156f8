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
  static constexpr WatchMoment kNeeded{.needed = true}, kIdle{}, kSeesAll{.sees = true, .sees_all = true},
      kSeesOne{.sees = true}, kNeededSeesOne{.needed = true, .sees = true};

  static Time At(double s) { return FromUtime(1'000'000'000) + FromSeconds(s); }
  static FrameNotice Frame(std::int32_t id, double exposed_s, int camera = kThird) {
    FrameNotice frame;
    frame.frame_id = id;
    frame.camera = camera;
    frame.exposure = At(exposed_s);
    return frame;
  }
  Action Step(const WatchMoment& moment, double s) { return dut_.Step(moment, here_, At(s)); }

  HeadSetting here_{.pan_rad = 0.1, .tilt_rad = 0.5};
  LaserWatch dut_{TwicePerSecond()};
};

TEST_F(LaserWatchTest, SwitchedOffItLeavesTheHeadAlone) {
  LaserWatch off{LaserWatchConfig{}};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(off.Step(kSeesOne, here_, At(0.1 * i)), Action::kWait);
}

TEST_F(LaserWatchTest, TurnsDownOnlyWhenNobodyHasNeededTheHeadForAWhile) {
  EXPECT_EQ(Step(kNeeded, 0), Action::kWait);
  EXPECT_EQ(Step(kIdle, 0.1), Action::kWait);
  EXPECT_EQ(Step(kIdle, 1.05), Action::kWait);
  EXPECT_EQ(Step(kIdle, 1.15), Action::kLower);
  EXPECT_EQ(Step(kIdle, 1.2), Action::kWait) << "once is enough";
  EXPECT_EQ(Step(kNeeded, 1.3), Action::kWait);
  EXPECT_EQ(Step(kIdle, 1.4), Action::kWait) << "a look begins the wait anew";
}

TEST_F(LaserWatchTest, AHeadThatDoesNotComeDownIsToldAgain) {
  Step(kIdle, 0);
  EXPECT_EQ(Step(kIdle, 1.1), Action::kLower);
  EXPECT_EQ(Step(kIdle, 6.0), Action::kWait);
  EXPECT_EQ(Step(kIdle, 6.2), Action::kLower);
}

TEST_F(LaserWatchTest, WhereItSeesALinePicturesAreTakenThoughTheHeadIsNeeded) {
  EXPECT_EQ(Step(kNeededSeesOne, 0), Action::kTrigger);
  EXPECT_EQ(Step(kNeededSeesOne, 0.2), Action::kWait) << "not faster than its rate";
  EXPECT_EQ(Step({.needed = true, .sees = true, .exposing = true}, 0.6), Action::kWait)
      << "the pictures of a look go first";
  EXPECT_EQ(Step(kNeededSeesOne, 0.62), Action::kTrigger);
}

TEST_F(LaserWatchTest, AnIdleHeadThatSeesOnlyOneLineTurnsToSeeAll) {
  EXPECT_EQ(Step(kSeesOne, 0), Action::kTrigger);
  EXPECT_EQ(Step(kSeesOne, 1.1), Action::kLower);
  EXPECT_EQ(Step(kSeesAll, 1.6), Action::kTrigger);
  EXPECT_EQ(Step(kSeesAll, 7), Action::kTrigger) << "where it sees them it stays";
}

TEST_F(LaserWatchTest, EachPictureIsTakenOnceWithTheSettingOfItsExposure) {
  ASSERT_EQ(Step(kSeesAll, 1.1), Action::kTrigger);
  const std::int32_t first = dut_.frame_id();
  EXPECT_FALSE(dut_.Takes(Frame(first, 1.11, kLeft))) << "another camera's";
  EXPECT_FALSE(dut_.Takes(Frame(first - 1, 1.11)));
  const auto setting = dut_.Takes(Frame(first, 1.11));
  ASSERT_TRUE(setting);
  EXPECT_EQ(setting->pan_rad, here_.pan_rad);
  EXPECT_FALSE(dut_.Takes(Frame(first, 1.11)));
  ASSERT_EQ(Step(kSeesAll, 1.7), Action::kTrigger);
  EXPECT_NE(dut_.frame_id(), first);
}

TEST_F(LaserWatchTest, ItsPicturesNeverHaveTheNumberOfALook) {
  for (int i = 0; i < 0x10002; ++i) {
    ASSERT_EQ(Step(kSeesAll, 1 + i), Action::kTrigger);
    ASSERT_GE(dut_.frame_id(), 0x40000000);
    ASSERT_LE(dut_.frame_id(), 0x4000FFFF);
  }
}

TEST_F(LaserWatchTest, APictureOfAHeadThatMovedDuringTheExposureIsNotTaken) {
  ASSERT_EQ(Step(kSeesAll, 1.1), Action::kTrigger);
  dut_.Report(here_, true, At(1.11));
  EXPECT_FALSE(dut_.Takes(Frame(dut_.frame_id(), 1.108)));
}

TEST_F(LaserWatchTest, APictureOfAHeadThatLeftAfterwardsIsTaken) {
  ASSERT_EQ(Step(kSeesAll, 1.1), Action::kTrigger);
  dut_.Report(here_, false, At(1.12));
  HeadSetting gone = here_;
  gone.tilt_rad = 0;
  dut_.Report(gone, true, At(1.14));
  const auto setting = dut_.Takes(Frame(dut_.frame_id(), 1.108));
  ASSERT_TRUE(setting);
  EXPECT_EQ(setting->tilt_rad, here_.tilt_rad);
}

TEST(SeesLineTest, OnlyACameraThatLooksDownDoes) {
  const support::LaserFloor scene = support::NominalLaserFloor();
  EXPECT_TRUE(SeesLine(scene.camera, scene.lasers[0], {}));
  HeadSetting level;
  const CameraModel up = MakeCameraModel({900, {383.5, 287.5}, -0.05, 0, 0.02},
                                         HeadGeometry().BaseFromCamera(level, kThird, 0.02));
  EXPECT_FALSE(SeesLine(up, scene.lasers[0], {}));
}

TEST(SeesLineTest, TheLineIsNotNearTheUpperOrLowerBorder) {
  const LaserPlane laser = support::NominalLaserFloor().lasers[0];
  const Eigen::Vector3d line_ahead(-laser.offset_m / laser.normal.x(), 0, 0);
  int above = 0, below = 0;
  for (double tilt_deg = 20; tilt_deg < 60; tilt_deg += 0.25) {
    const CameraModel camera = support::ThirdCamera(Radians(tilt_deg));
    const double row = camera.Project(line_ahead).y() / 576;
    EXPECT_EQ(SeesLine(camera, laser, {}), row > 0.1 && row < 0.9) << tilt_deg << " deg, row " << row;
    above += row > 0 && row < 0.1;
    below += row > 0.9 && row < 1;
  }
  EXPECT_GT(above, 5);
  EXPECT_GT(below, 5);
}

TEST(SeesLineTest, AHeadThatIsTurnedAsideSeesOneEndUntilItIsTurnedFarther) {
  HeadModel head;
  head.lenses[kThird] = LensTable({0}, {0}, {LensState{900, {383.5, 287.5}, -0.05, 0, 0.02}});
  head.lasers = support::NominalLaserPair().lasers;
  const auto seen = [&](double pan_deg) {
    return LinesSeen(head, {.pan_rad = Radians(pan_deg), .tilt_rad = Radians(12)});
  };
  EXPECT_EQ(seen(0), 1U);
  EXPECT_EQ(seen(-25), 1U);
  EXPECT_EQ(seen(60), 0U);
}

TEST(SeesLineTest, AHeadDoesWithItsThirdCameraAndKnownLasers) {
  HeadModel head;
  head.lenses[kThird] = LensTable({0}, {0}, {LensState{900, {383.5, 287.5}, -0.05, 0, 0.02}});
  const HeadSetting down{.tilt_rad = Radians(LaserWatchConfig{}.tilt_deg)};
  EXPECT_EQ(LinesSeen(head, down), 0U) << "no laser is calibrated";
  head.lasers = support::NominalLaserPair().lasers;
  EXPECT_EQ(LinesSeen(head, down), 2U);
  EXPECT_EQ(LinesSeen(head, {.tilt_rad = Radians(12)}), 1U) << "the far one, in a glance ahead";
  EXPECT_EQ(LinesSeen(head, {.tilt_rad = Radians(-5)}), 0U) << "none in a look";
  head.lenses[kThird] = LensTable();
  EXPECT_EQ(LinesSeen(head, down), 0U);
}

}  // namespace
}  // namespace priamos::head
