#include "world/core/drive_board.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/geometry.hpp"

namespace priamos::world {
namespace {

constexpr Duration kStep{2500};

/// Runs `dut` for `seconds`, repeating the command every 20 ms while `commanded`.
Time Elapse(DriveBoard& dut, Time now, double seconds, const PerWheel* commanded) {
  const int steps = static_cast<int>(std::lround(seconds / Seconds(kStep)));
  for (int i = 0; i < steps; ++i) {
    if (commanded && i % 8 == 0) dut.Command(now, *commanded);
    now += kStep;
    dut.Step(now, kStep);
  }
  return now;
}

class DriveBoardTest : public ::testing::Test {
 protected:
  DriveBoardConfig config_;
  DriveBoard dut_{config_, Rng(1)};
  const Time start_ = FromUtime(1'000'000);
  const PerWheel forward_{5, 5, 5, 5};
};

TEST_F(DriveBoardTest, StandsStoppedBeforeTheFirstCommand) {
  Elapse(dut_, start_, 1, nullptr);
  EXPECT_EQ(dut_.speed_rad_s(), PerWheel{});
  EXPECT_TRUE(dut_.Read().deadline_stopped);
}

TEST_F(DriveBoardTest, SpeedNeverOutrunsTheRamp) {
  Time now = start_;
  double before = 0;
  for (int i = 0; i < 100; ++i) {
    dut_.Command(now, forward_);
    now += kStep;
    dut_.Step(now, kStep);
    EXPECT_LE(dut_.speed_rad_s()[0] - before, config_.acceleration_rad_s2 * Seconds(kStep) + 1e-9);
    before = dut_.speed_rad_s()[0];
  }
}

TEST_F(DriveBoardTest, ReachesTheCommandedSpeed) {
  Elapse(dut_, start_, 1, &forward_);
  EXPECT_NEAR(dut_.speed_rad_s()[2], 5, 0.01);
  EXPECT_FALSE(dut_.Read().deadline_stopped);
}

TEST_F(DriveBoardTest, LagsOneTimeConstantBehindTheRamp) {
  Elapse(dut_, start_, 0.3, &forward_);
  // On a long ramp a first-order lag trails by slope times time constant.
  EXPECT_NEAR(dut_.speed_rad_s()[0], config_.acceleration_rad_s2 * (0.3 - config_.lag_s), 0.05);
}

TEST_F(DriveBoardTest, SilenceStopsTheWheelsWithinDeadlineAndBraking) {
  const Time last = Elapse(dut_, start_, 1, &forward_) - Duration(8 * kStep);
  Time now = last + Duration(8 * kStep);
  now = Elapse(dut_, now, 0.175, nullptr);  // 195 ms after the last command
  EXPECT_FALSE(dut_.Read().deadline_stopped);
  EXPECT_NEAR(dut_.speed_rad_s()[0], 5, 0.01);
  now = Elapse(dut_, now, 0.005, nullptr);  // 200 ms
  EXPECT_TRUE(dut_.Read().deadline_stopped);
  // 5 rad/s at 30 rad/s^2 and six time constants of lag.
  Elapse(dut_, now, 5.0 / 30 + 6 * config_.lag_s, nullptr);
  EXPECT_LT(std::abs(dut_.speed_rad_s()[0]), 0.05);
  Elapse(dut_, now, 1, nullptr);
  EXPECT_EQ(dut_.speed_rad_s()[0], 0);
}

TEST_F(DriveBoardTest, ANewCommandEndsADeadlineStop) {
  Time now = Elapse(dut_, start_, 1, nullptr);
  Elapse(dut_, now, 1, &forward_);
  EXPECT_FALSE(dut_.Read().deadline_stopped);
  EXPECT_NEAR(dut_.speed_rad_s()[0], 5, 0.01);
}

TEST_F(DriveBoardTest, ClampsToTheSpeedLimit) {
  const PerWheel fast{29, -29, 3, 0};
  Elapse(dut_, start_, 3, &fast);
  EXPECT_NEAR(dut_.speed_rad_s()[0], config_.max_speed_rad_s, 0.01);
  EXPECT_NEAR(dut_.speed_rad_s()[1], -config_.max_speed_rad_s, 0.01);
}

TEST_F(DriveBoardTest, ACommandThatIsNotFiniteDoesNotFeedTheDeadline) {
  Time now = Elapse(dut_, start_, 1, &forward_);
  const PerWheel bad{5, std::numeric_limits<double>::quiet_NaN(), 5, 5};
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(dut_.Command(now, bad));
    now += kStep;
    dut_.Step(now, kStep);
  }
  EXPECT_TRUE(dut_.Read().deadline_stopped);
}

TEST_F(DriveBoardTest, EncodersCountTheTurn) {
  Elapse(dut_, start_, 2, &forward_);
  // The ramp and the lag together cost 5/15/2 s + 0.04 s of full speed.
  const double turned = 5 * (2 - 5.0 / 15 / 2 - config_.lag_s);
  EXPECT_NEAR(dut_.Read().position_ticks[3], turned / (2 * kPi) * config_.ticks_per_turn, 10);
}

TEST_F(DriveBoardTest, EncodersJitterWhileTurningAndAreQuietAtRest) {
  Time now = Elapse(dut_, start_, 1, &forward_);
  const auto spread = [&] {
    std::int32_t low = dut_.Read().position_ticks[0], high = low;
    for (int i = 0; i < 200; ++i) {
      low = std::min(low, dut_.Read().position_ticks[0]);
      high = std::max(high, dut_.Read().position_ticks[0]);
    }
    return high - low;
  };
  EXPECT_GE(spread(), 2);
  EXPECT_LE(spread(), 8);
  Elapse(dut_, now, 2, nullptr);
  EXPECT_EQ(spread(), 0);
}

}  // namespace
}  // namespace priamos::world
