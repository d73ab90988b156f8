#include "robot/core/safety/push_estimator.hpp"

#include <gtest/gtest.h>

#include "robot/core/safety/touch_watch.hpp"

namespace priamos::robot {
namespace {

constexpr double kPeriod = 0.02, kRolling_n = 0.015 * 180 * 9.81;

/// Samples every 20 ms of a base whose wheels push as the test says.
class PushEstimatorTest : public testing::Test {
 protected:
  /// One sample with this velocity and these forces of the wheels [N].
  void Sample(const Twist2& twist, const std::array<double, 4>& force_n) {
    now_ += FromSeconds(kPeriod);
    dut_.AddMotion(now_, twist);
    MotorCurrents currents{now_, {}};
    for (std::size_t i = 0; i < 4; ++i) currents.current_a[i] = force_n[i] / 20;
    dut_.AddCurrents(currents);
  }
  void Even(int samples, const Twist2& twist, double force_n) {
    const double each = force_n / 4;
    for (int i = 0; i < samples; ++i) Sample(twist, {each, each, each, each});
  }

  PushEstimator dut_{PushConfig{}, MecanumGeometry{}};
  Time now_ = FromUtime(1'000'000);
};

TEST_F(PushEstimatorTest, SaysNothingBeforeItsWindowIsFull) {
  Even(6, {0.3, 0, 0}, kRolling_n);
  EXPECT_FALSE(dut_.Push());
  Even(1, {0.3, 0, 0}, kRolling_n);
  EXPECT_TRUE(dut_.Push());
}

TEST_F(PushEstimatorTest, SaysNothingWithoutCurrents) {
  for (int i = 0; i < 20; ++i) dut_.AddMotion(now_ += FromSeconds(kPeriod), {0.3, 0, 0});
  EXPECT_FALSE(dut_.Push());
}

TEST_F(PushEstimatorTest, ABaseThatRollsFreelyPushesNothing) {
  Even(20, {0.3, 0, 0}, kRolling_n);
  EXPECT_LT(dut_.Push()->norm(), 1);
  for (int i = 0; i < 20; ++i)
    Sample({0, 0.3, 0}, {-kRolling_n / 4, kRolling_n / 4, kRolling_n / 4, -kRolling_n / 4});
  EXPECT_LT(dut_.Push()->norm(), 1);
}

TEST_F(PushEstimatorTest, ARampOfTheSpeedIsNoPush) {
  Even(10, {0, 0, 0}, 0);
  for (int i = 1; i <= 30; ++i) {
    // Encoders give the mean velocity since the sample before, currents the force of the moment.
    const auto speed = [](double t) { return std::min(0.3, 1.5 * t); };
    const double now = kPeriod * i, mean = (speed(now) + speed(now - kPeriod)) / 2;
    Even(1, {mean, 0, 0}, (speed(now) < 0.3 ? 180 * 1.5 : 0) + kRolling_n);
    EXPECT_LT(dut_.Push()->norm(), TouchConfig{}.push_n / 2) << i;
  }
}

TEST_F(PushEstimatorTest, AHeldBasePushesInTheDirectionOfItsWheels) {
  Even(10, {0.3, 0, 0}, kRolling_n);
  Even(10, {0.3, 0, 0}, 600 + kRolling_n);
  EXPECT_NEAR(dut_.Push()->x(), 600, 10);
  EXPECT_NEAR(dut_.Push()->y(), 0, 1);
  for (int i = 0; i < 10; ++i) Sample({0, 0, 0}, {-100, 100, 100, -100});
  EXPECT_NEAR(dut_.Push()->y(), 400, 10) << "to the left, with the wheels at rest";
  for (int i = 0; i < 10; ++i) Sample({0, 0, 0}, {-100, 100, -100, 100});
  EXPECT_NEAR(dut_.Push()->z(), 400, 10) << "turning";
}

TEST_F(PushEstimatorTest, APushShowsWithinATenthOfASecond) {
  Even(10, {0.3, 0, 0}, kRolling_n);
  Even(4, {0.3, 0, 0}, 600 + kRolling_n);
  EXPECT_GT(dut_.Push()->x(), 150);
}

TEST_F(PushEstimatorTest, TimeThatStepsBackBeginsAnew) {
  Even(20, {0.3, 0, 0}, kRolling_n);
  now_ -= std::chrono::seconds(5);
  Even(2, {0.3, 0, 0}, 5000);
  EXPECT_FALSE(dut_.Push());
}

}  // namespace
}  // namespace priamos::robot
