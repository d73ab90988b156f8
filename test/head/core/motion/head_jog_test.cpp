#include "head/core/motion/head_jog.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace priamos::head {
namespace {

using std::chrono::milliseconds;

struct HeadJogTest : testing::Test {
  HeadWish Wish(double pan_rad_s) {
    HeadWish wish;
    wish.time = now;
    wish.time_to_live = milliseconds(200);
    wish.sequence = ++sequence;
    wish.pan_rad_s = pan_rad_s;
    return wish;
  }
  /// One wish every 40 ms for so long.
  void Hold(double pan_rad_s, int ms) {
    for (int t = 0; t < ms; t += 10) {
      if (t % 40 == 0) dut.Take(Wish(pan_rad_s), now);
      if (const auto setting = dut.Step(here, now)) here = *setting;
      now += milliseconds(10);
    }
  }

  HeadJog dut;
  HeadSetting here;
  Time now = FromUtime(1'000'000);
  int sequence = 65500;  // wraps on the way
};

TEST_F(HeadJogTest, TurnsAsFastAsWished) {
  Hold(0.4, 1000);
  EXPECT_NEAR(here.pan_rad, 0.4, 0.03);
  EXPECT_EQ(dut.refused(), 0);
}

TEST_F(HeadJogTest, SilenceStopsIt) {
  Hold(0.4, 500);
  now += milliseconds(201);
  EXPECT_FALSE(dut.Step(here, now));
}

TEST_F(HeadJogTest, AWishToStandStopsItAtOnce) {
  Hold(0.4, 500);
  dut.Take(Wish(0), now);
  EXPECT_FALSE(dut.Step(here, now));
}

TEST_F(HeadJogTest, StopsAtTheEndOfTheAxes) {
  Hold(1.0, 5000);
  EXPECT_EQ(here.pan_rad, 2.0);
}

TEST_F(HeadJogTest, WhoPausesForLessThanHalfASecondStillHoldsTheHead) {
  EXPECT_FALSE(dut.IsHeld(now));
  Hold(0.4, 60);  // its last step is 10 ms ago
  dut.Stop();
  EXPECT_TRUE(dut.IsHeld(now + milliseconds(489)));
  EXPECT_FALSE(dut.IsHeld(now + milliseconds(490)));
}

TEST_F(HeadJogTest, VergenceTurnsTheCamerasTowardsEachOther) {
  HeadWish wish = Wish(0);
  wish.vergence_rad_s = 0.1;
  dut.Take(wish, now);
  const auto setting = dut.Step(here, now);
  ASSERT_TRUE(setting);
  EXPECT_LT(setting->vergence_rad[0], 0);
  EXPECT_GT(setting->vergence_rad[1], 0);
}

TEST_F(HeadJogTest, OldDoubleAndSenselessWishesAreRefused) {
  const HeadWish wish = Wish(0.4);
  EXPECT_TRUE(dut.Take(wish, now));
  EXPECT_FALSE(dut.Take(wish, now)) << "double";
  HeadWish late = Wish(0.4);
  EXPECT_FALSE(dut.Take(late, now + milliseconds(201)));
  EXPECT_FALSE(dut.Take(Wish(std::numeric_limits<double>::quiet_NaN()), now));
  HeadWish eternal = Wish(0.4);
  eternal.time_to_live = std::chrono::hours(1);
  EXPECT_FALSE(dut.Take(eternal, now));
  EXPECT_EQ(dut.refused(), 4);
}

}  // namespace
}  // namespace priamos::head
