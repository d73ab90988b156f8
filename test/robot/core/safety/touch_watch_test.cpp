#include "robot/core/safety/touch_watch.hpp"

#include <gmock/gmock.h>

namespace priamos::robot {
namespace {

using testing::Each;
using testing::IsEmpty;
using testing::SizeIs;

class TouchWatchTest : public testing::Test {
 protected:
  std::optional<Touch> Step(std::uint8_t pressed, const Pose2& base = {}) {
    now_ += std::chrono::milliseconds(20);
    dut_.AddBumper(pressed, now_);
    return dut_.Update(base, now_);
  }
  /// Drives straight ahead for a while with these forces of the wheels together [N]; the touches noticed.
  std::vector<Touch> Push(double force_n, int samples) {
    std::vector<Touch> touches;
    for (int i = 0; i < samples; ++i) {
      now_ += std::chrono::milliseconds(20);
      dut_.AddMotion(now_, {0.3, 0, 0});
      const double each = force_n / 4 / 20;
      dut_.AddCurrents({now_, {each, each, each, each}});
      if (const auto touch = dut_.Update({}, now_)) touches.push_back(*touch);
    }
    return touches;
  }

  TouchWatch dut_{TouchConfig{}, Footprint{}, MecanumGeometry{}};
  Time now_ = FromUtime(1'000'000);
};

TEST_F(TouchWatchTest, ASwitchThatClosesIsATouchOnce) {
  EXPECT_FALSE(Step(0));
  const auto touch = Step(1);
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->segments, 1);
  EXPECT_EQ(touch->time, now_);
  EXPECT_FALSE(Step(1)) << "it is still closed";
  EXPECT_EQ(Step(1 + 2)->segments, 2) << "another one closes";
  EXPECT_FALSE(Step(0));
  EXPECT_TRUE(Step(1)) << "again";
}

TEST_F(TouchWatchTest, WhoComesToAStandingBaseLeavesNoPlaceBehind) {
  dut_.AddBumper(1, now_ += std::chrono::milliseconds(20));
  const auto touch = dut_.Update({}, now_, Twist2{0, 0, 0});
  ASSERT_TRUE(touch);
  EXPECT_TRUE(touch->came);
  EXPECT_TRUE(dut_.pressed());
  EXPECT_THAT(dut_.Points({}), IsEmpty());
  EXPECT_FALSE(Step(0));
  EXPECT_FALSE(dut_.pressed());
  EXPECT_FALSE(Step(1)->came);
}

TEST_F(TouchWatchTest, WhoWalksIntoABaseThatGoesTheOtherWayHasCome) {
  // Segments: the halves of the front 0 and 7, of the left side 1 and 2, of the rear 3 and 4.
  const auto came = [this](std::uint8_t segment, const Twist2& motion) {
    Step(0);
    dut_.AddBumper(static_cast<std::uint8_t>(1 << segment), now_ += std::chrono::milliseconds(20));
    return dut_.Update({}, now_, motion)->came;
  };
  for (const int front : {0, 7}) EXPECT_FALSE(came(front, {0.3, 0, 0}));
  for (const int rear : {3, 4}) EXPECT_TRUE(came(rear, {0.3, 0, 0}));
  EXPECT_TRUE(came(0, {-0.1, 0, 0}));
  EXPECT_TRUE(came(1, {0.3, -0.1, 0}));
  EXPECT_FALSE(came(1, {0.3, 0.1, 0}));
  EXPECT_FALSE(came(4, {0, 0, 0.2})) << "a turning base sweeps everywhere";
}

TEST_F(TouchWatchTest, TheRollingResistanceIsNoTouchAndAForceIsOneOnce) {
  EXPECT_THAT(Push(26, 50), IsEmpty());
  const auto touches = Push(600, 50);
  ASSERT_THAT(touches, SizeIs(1));
  EXPECT_EQ(touches[0].segments, 0x81) << "the front";
  EXPECT_GT(touches[0].push_n, 150);
  Push(26, 50);
  EXPECT_THAT(Push(600, 50), SizeIs(1)) << "a new push is a new touch";
}

TEST_F(TouchWatchTest, TheTouchedPlaceStaysWhereItIsForAWhile) {
  Step(1, {2, 0, 0});
  const auto points = dut_.Points({1, 0, 0});
  ASSERT_THAT(points, Not(IsEmpty()));
  for (const Eigen::Vector2d& point : points) {
    EXPECT_NEAR(point.x(), 1 + 0.475, 0.01);
    EXPECT_GE(point.y(), -0.01);
    EXPECT_LE(point.y(), 0.40);
  }
  now_ += std::chrono::seconds(61);
  Step(0);
  EXPECT_THAT(dut_.Points({1, 0, 0}), IsEmpty());
}

TEST_F(TouchWatchTest, APlaceLiesOutsideOfTheFootprint) {
  Step(0xff);
  const Footprint footprint;
  for (const Eigen::Vector2d& point : dut_.Points({})) EXPECT_GT(footprint.Distance(point), 0);
}

TEST_F(TouchWatchTest, TouchesWithoutEndDoNotGrow) {
  for (int i = 0; i < 1000; ++i) Step(i % 2 == 0 ? 0xff : 0);
  EXPECT_LE(dut_.Points({}).size(), 250U);
}

TEST(SegmentsText, NamesTheHalves) {
  EXPECT_EQ(SegmentsText(1), "the front's left half");
  EXPECT_EQ(SegmentsText(0x81), "the front's left half, the front's right half");
  EXPECT_EQ(SegmentsText(0), "no known side");
}

}  // namespace
}  // namespace priamos::robot
