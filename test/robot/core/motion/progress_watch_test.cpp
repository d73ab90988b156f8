#include "robot/core/motion/progress_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::robot {
namespace {

constexpr ProgressWatch::Limits kLimits{FromSeconds(3), FromSeconds(15)};

constexpr Time At(double seconds) {
  return FromUtime(1'000'000'000 + static_cast<std::int64_t>(seconds * 1e6));
}

TEST(ProgressWatch, ABaseThatDrivesOrTurnsGetsOn) {
  ProgressWatch driving(kLimits), turning(kLimits);
  for (double t = 0; t < 40; t += 0.02) {
    EXPECT_FALSE(driving.GetsNowhere({0.05 * t, 0, 0}, 3 - 0.05 * t, At(t))) << t;
    EXPECT_FALSE(turning.GetsNowhere({0, 0, 0.1 * t}, 3 - 0.05 * t, At(t))) << t;
  }
}

TEST(ProgressWatch, ABaseThatStandsOrGoesToAndFroByAHandsBreadthGetsNowhere) {
  ProgressWatch dut(kLimits);
  for (double t = 0; t < 20; t += 0.02) {
    const double x = 0.04 * std::sin(2 * t);
    EXPECT_EQ(dut.GetsNowhere({x, 0, 0}, 3 - x, At(t)), At(t) - At(0) > FromSeconds(3)) << t;
  }
}

TEST(ProgressWatch, ABaseThatGoesAboutBeforeWhatClosesTheWayGetsNowhere) {
  ProgressWatch dut(kLimits);
  for (double t = 0; t < 40; t += 0.02) {
    const double x = -0.5 + 0.5 * std::cos(0.5 * t), y = std::sin(0.5 * t);
    EXPECT_EQ(dut.GetsNowhere({x, y, 0}, 3 - x, At(t)), At(t) - At(0) > FromSeconds(15)) << t;
  }
}

TEST(ProgressWatch, GetsOnAgainWhenTheWayIsFree) {
  ProgressWatch dut(kLimits);
  for (double t = 0; t < 20; t += 0.02) dut.GetsNowhere({std::sin(t), 0, 0}, 3, At(t));
  EXPECT_TRUE(dut.GetsNowhere({0, 0, 0}, 2.95, At(20.1)));
  EXPECT_FALSE(dut.GetsNowhere({0.2, 0, 0}, 2.8, At(20.5)));
}

TEST(ProgressWatch, BeginsAnewWhenItIsReset) {
  ProgressWatch dut(kLimits);
  dut.GetsNowhere({}, 1, At(0));
  EXPECT_TRUE(dut.GetsNowhere({}, 1, At(4)));
  dut.Reset();
  EXPECT_FALSE(dut.GetsNowhere({}, 5, At(5)));
  EXPECT_FALSE(dut.GetsNowhere({}, 5, At(8)));
}

}  // namespace
}  // namespace priamos::robot
