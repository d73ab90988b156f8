#include "robot/core/sonar/opening_watch.hpp"

#include <gtest/gtest.h>

namespace priamos::robot {
namespace {

/// A base that drives along x at 0.3 m/s; its ring hears what the test puts beside it.
class OpeningWatchTest : public testing::Test {
 protected:
  /// Drives so far; `left` and `right` are the ranges abeam, -1 for no echo.
  std::optional<Opening> Drive(double distance_m, double left, double right) {
    std::optional<Opening> found;
    for (double d = 0; d < distance_m - 1e-9; d += 0.03) {
      now_ += std::chrono::milliseconds(100);
      odom_.x += 0.03;
      if (auto opening = Hear(left, right)) found = opening;
    }
    return found;
  }
  std::optional<Opening> Hear(double left, double right) {
    SonarCycle cycle{.time = now_, .range_m = {}};
    cycle.range_m.fill(-1);
    for (int i = 5; i < 8; ++i) cycle.range_m[i] = left;
    for (int i = 17; i < 20; ++i) cycle.range_m[i] = right;
    return dut_.Add(cycle, odom_, Pose2{10, 5, kPi / 2} * odom_);
  }

  OpeningWatch dut_{OpeningConfig{}, Footprint{}};
  Time now_ = FromUtime(1'000'000);
  Pose2 odom_;
};

TEST_F(OpeningWatchTest, BothSidesNearThenFreeIsAnOpening) {
  EXPECT_FALSE(Drive(1, 1.5, 2.0));
  EXPECT_FALSE(Drive(0.3, 0.1, 0.12));
  const auto opening = Drive(0.3, 1.5, -1);
  ASSERT_TRUE(opening);
  EXPECT_NEAR(opening->width_m, 0.78 + 0.22, 1e-9);
  // Near from 1.05 to 1.32 m on.
  EXPECT_NEAR(opening->map_from_base.x, 10, 1e-9);
  EXPECT_NEAR(opening->map_from_base.y, 5 + 1.18, 0.04);
  EXPECT_FALSE(Drive(1, 1.5, -1)) << "once";
}

TEST_F(OpeningWatchTest, ALeafBesideTheBaseBehindTheDoorDoesNotHideIt) {
  Drive(0.3, 0.1, 0.12);
  EXPECT_TRUE(Drive(0.3, 0.2, -1));
}

TEST_F(OpeningWatchTest, AnEchoThatIsLostOnceEndsNothing) {
  Drive(0.1, 0.1, 0.12);
  EXPECT_FALSE(Drive(0.03, -1, 0.12));
  Drive(0.1, 0.1, 0.12);
  EXPECT_TRUE(Drive(0.1, -1, -1));
}

TEST_F(OpeningWatchTest, OneSideAloneIsAWall) {
  Drive(1, 0.1, 1.5);
  EXPECT_FALSE(Drive(0.5, -1, -1));
}

TEST_F(OpeningWatchTest, WhoStandsOrGoesBackPassesNothing) {
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(Hear(0.1, 0.1));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(Hear(-1, -1));
  Drive(0.3, 0.1, 0.1);
  odom_.x -= 0.3;
  Hear(0.1, 0.1);
  EXPECT_FALSE(Drive(0.5, -1, -1));
}

TEST_F(OpeningWatchTest, IntoACabinAndOutOfItAgain) {
  Drive(1, 1.5, 2.0);
  EXPECT_FALSE(Drive(0.3, 0.1, 0.11));
  const auto into = Drive(0.6, 0.16, 0.17);
  ASSERT_TRUE(into);
  EXPECT_NEAR(into->width_m, 0.78 + 0.21, 1e-9);
  EXPECT_NEAR(into->map_from_base.y, 5 + 1.18, 0.04);
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(Hear(0.16, 0.17)) << "it stands";
  EXPECT_FALSE(Drive(0.3, 0.1, 0.11));
  const auto out = Drive(0.3, 1.5, 2.0);
  ASSERT_TRUE(out);
}

TEST_F(OpeningWatchTest, ACorridorThatIsNoWiderSomewhereIsNone) {
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(Drive(0.09, 0.20, 0.21));
    EXPECT_FALSE(Drive(0.09, 0.22, 0.23));
  }
}

}  // namespace
}  // namespace priamos::robot
