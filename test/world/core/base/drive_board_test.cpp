#include "world/core/base/drive_board.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/geometry.hpp"

namespace priamos::world {
namespace {

constexpr Duration kStep{2500};
constexpr std::int32_t kRobot = 17, kSecond = -4;

/// Runs `dut` for `seconds`, repeating the command every 20 ms while `commanded`.
Time Elapse(DriveBoard& dut, Time now, double seconds, const PerWheel* commanded) {
  const int steps = static_cast<int>(std::lround(seconds / Seconds(kStep)));
  for (int i = 0; i < steps; ++i) {
    if (commanded && i % 8 == 0) dut.Command(now, kRobot, *commanded);
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
    dut_.Command(now, kRobot, forward_);
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
    EXPECT_FALSE(dut_.Command(now, kRobot, bad));
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

TEST_F(DriveBoardTest, AWheelTurnsByTheMeanSpeedOfEachStep) {
  config_.encoder_noise_ticks = 0;
  config_.ticks_per_turn = 100'000;
  DriveBoard dut(config_, Rng(1));
  double turned = 0;
  Time now = start_;
  for (double before = 0; now < start_ + std::chrono::milliseconds(200); before = dut.speed_rad_s()[0]) {
    now = Elapse(dut, now, Seconds(kStep), &forward_);
    turned += Seconds(kStep) * (before + dut.speed_rad_s()[0]) / 2;
  }
  EXPECT_NEAR(dut.Read().position_ticks[0], turned / (2 * kPi) * config_.ticks_per_turn, 1);
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

// ---- Two that command.

/// The robot goes on, and `second` commands beside it, 10 ms later each time.
Time ElapseWithTwo(DriveBoard& dut, Time now, double seconds, const PerWheel& robot, const PerWheel& second) {
  const int steps = static_cast<int>(std::lround(seconds / Seconds(kStep)));
  for (int i = 0; i < steps; ++i) {
    if (i % 8 == 0) dut.Command(now, kRobot, robot);
    if (i % 8 == 4) dut.Command(now, kSecond, second);
    now += kStep;
    dut.Step(now, kStep);
  }
  return now;
}

TEST_F(DriveBoardTest, ObeysNeitherOfTwoAndBrakes) {
  Time now = Elapse(dut_, start_, 1, &forward_);
  const PerWheel backward{-5, -5, -5, -5};
  const double travelled = 5.0 / 30 + 6 * config_.lag_s;
  now = ElapseWithTwo(dut_, now, travelled, forward_, backward);
  EXPECT_LT(std::abs(dut_.speed_rad_s()[0]), 0.05);
  now = ElapseWithTwo(dut_, now, 1, forward_, backward);
  EXPECT_EQ(dut_.speed_rad_s(), PerWheel{});
  const WheelReading reading = dut_.Read();
  EXPECT_TRUE(reading.contested);
  EXPECT_FALSE(reading.deadline_stopped);
  EXPECT_EQ(reading.instance, kRobot);
  EXPECT_EQ(reading.foreign_commands, std::lround((travelled + 1) / 0.02));
}

TEST_F(DriveBoardTest, ObeysTheFirstAgainWhenTheSecondIsSilentAndTheWheelsHaveStood) {
  Time now = Elapse(dut_, start_, 1, &forward_);
  dut_.Command(now, kSecond, {-5, -5, -5, -5});
  bool stood = false;
  do {
    now = Elapse(dut_, now, Seconds(kStep), &forward_);
    stood = stood || dut_.speed_rad_s() == PerWheel{};
    ASSERT_LT(now, start_ + std::chrono::seconds(2)) << "they are held for ever";
  } while (dut_.Read().contested);
  EXPECT_TRUE(stood);
  EXPECT_GE(now, start_ + std::chrono::milliseconds(1200)) << "the deadline after the second one's command";
  Elapse(dut_, now, 1, &forward_);
  EXPECT_NEAR(dut_.speed_rad_s()[0], 5, 0.01);
}

TEST_F(DriveBoardTest, HoldsStandingWheelsForTheDeadline) {
  const PerWheel standing{};
  Time now = Elapse(dut_, start_, 1, &standing);
  dut_.Command(now, kSecond, forward_);
  now = Elapse(dut_, now, 0.195, &forward_);
  EXPECT_TRUE(dut_.Read().contested);
  EXPECT_EQ(dut_.speed_rad_s(), standing);
  now = Elapse(dut_, now, 0.01, &forward_);
  EXPECT_FALSE(dut_.Read().contested);
}

TEST_F(DriveBoardTest, TheSecondFollowsTheFirstNoSoonerThanAfterTheDeadline) {
  Time now = Elapse(dut_, start_, 1, &forward_);  // the last command is 20 ms old
  const PerWheel backward{-5, -5, -5, -5};
  const Time last = now - Duration(20'000);
  while (dut_.Read().instance == kRobot) {
    dut_.Command(now, kSecond, backward);
    now += kStep;
    dut_.Step(now, kStep);
    EXPECT_GE(dut_.speed_rad_s()[0], 0) << "the second is not obeyed yet";
  }
  EXPECT_NEAR(Seconds(now - last), config_.deadline_s, 0.006);
  for (int i = 0; i < 400; ++i) {
    dut_.Command(now, kSecond, backward);
    now += kStep;
    dut_.Step(now, kStep);
  }
  EXPECT_NEAR(dut_.speed_rad_s()[0], -5, 0.01);
  EXPECT_FALSE(dut_.Read().contested);
}

}  // namespace
}  // namespace priamos::world
