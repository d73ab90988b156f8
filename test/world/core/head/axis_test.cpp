#include "world/core/head/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/config.hpp"

namespace priamos::world {
namespace {

constexpr Duration kStep{2500};
constexpr AxisConfig kConfig{-2, 2, 0.0001, 1.5, 6, 0.004, 0};

/// Steps until the axis rests; returns the time it took [s].
double Settle(Axis& dut) {
  double seconds = 0;
  while (dut.moving() && seconds < 100) {
    dut.Step(kStep);
    seconds += Seconds(kStep);
  }
  return seconds;
}

TEST(AxisTest, CounterReachesTheTarget) {
  Axis dut(kConfig, 0, Rng(1));
  dut.MoveTo(0.17453);
  EXPECT_TRUE(dut.moving());
  Settle(dut);
  EXPECT_NEAR(dut.counter(), 0.1745, 1e-9);
}

TEST(AxisTest, TenDegreesTakeAccelerationAndBraking) {
  Axis dut(kConfig, 0, Rng(1));
  dut.MoveTo(0.1745);
  EXPECT_NEAR(Settle(dut), 2 * std::sqrt(0.1745 / 6), 0.02);
}

TEST(AxisTest, BrakesAtItsFullAccelerationDownToTheEnd) {
  for (const double turn : {0.1745, 0.3}) {
    Axis dut(kConfig, 0, Rng(1));
    dut.MoveTo(turn);
    EXPECT_LE(Settle(dut), 2 * std::sqrt(turn / 6)) << turn;
  }
}

TEST(AxisTest, LongMovesRunAtTheSpeedLimitAndDoNotOvershoot) {
  Axis dut(kConfig, -2, Rng(1));
  dut.MoveTo(2);
  double before = dut.counter(), fastest = 0;
  while (dut.moving()) {
    dut.Step(kStep);
    fastest = std::max(fastest, (dut.counter() - before) / Seconds(kStep));
    EXPECT_GE(dut.counter(), before);
    EXPECT_LE(dut.counter(), 2);
    before = dut.counter();
  }
  EXPECT_NEAR(fastest, 1.5, 0.05);
}

TEST(AxisTest, AChangedTargetOnTheWayIsReached) {
  Axis dut(kConfig, 0, Rng(1));
  dut.MoveTo(1);
  for (int i = 0; i < 100; ++i) dut.Step(kStep);
  dut.MoveTo(-0.5);
  Settle(dut);
  EXPECT_NEAR(dut.counter(), -0.5, 1e-9);
}

TEST(AxisTest, BacklashSeparatesTheTwoWaysToOneSetting) {
  Axis dut(kConfig, 0, Rng(1));
  dut.MoveTo(-0.2);
  Settle(dut);
  dut.MoveTo(0.1);
  Settle(dut);
  const double from_below = dut.position();
  dut.MoveTo(0.3);
  Settle(dut);
  dut.MoveTo(0.1);
  Settle(dut);
  EXPECT_NEAR(dut.position() - from_below, kConfig.backlash, 1e-9);
  EXPECT_NEAR(dut.counter(), 0.1, 1e-9);
}

TEST(AxisTest, TheAxisStandsStillWhileTheMotorCrossesThePlay) {
  Axis dut(kConfig, 0, Rng(1));
  dut.MoveTo(0.1);
  Settle(dut);
  const double before = dut.position();
  dut.MoveTo(0.098);
  Settle(dut);
  EXPECT_EQ(dut.position(), before);
}

TEST(AxisTest, TheSameWayComesBackWithinTheRepeatability) {
  AxisConfig config = kConfig;
  config.repeatability = 0.0001;
  Axis dut(config, 0, Rng(5));
  double low = 1, high = -1;
  for (int i = 0; i < 50; ++i) {
    dut.MoveTo(-0.1);
    Settle(dut);
    dut.MoveTo(0.1);
    Settle(dut);
    low = std::min(low, dut.position());
    high = std::max(high, dut.position());
  }
  EXPECT_GT(high - low, 0.0001);
  EXPECT_LT(high - low, 0.0007);
}

TEST(AxisTest, EndStopsHold) {
  Axis dut(kConfig, 0, Rng(1));
  dut.MoveTo(5);
  Settle(dut);
  EXPECT_NEAR(dut.counter(), 2, 1e-9);
}

TEST(AxisTest, TheSameTargetDoesNotMove) {
  Axis dut(kConfig, 0.1, Rng(1));
  dut.MoveTo(0.1);
  EXPECT_FALSE(dut.moving());
}

TEST(AxisConfigTest, EndStopsInTheWrongOrderAreRefused) {
  EXPECT_THROW(ParseConfig<LensAxisConfig>("test.toml", "min_step = 5\nmax_step = 4"), ConfigError);
}

}  // namespace
}  // namespace priamos::world
