#include "world/core/base/mecanum_base.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos::world {
namespace {

MecanumConfig Ideal() {
  MecanumConfig config;
  config.radius_error = config.lever_error = config.lateral_loss = config.roller_slip = 0;
  config.acceleration_slip_s2_m = 0;
  return config;
}

/// Pose after `seconds` of constant wheel speeds from rest.
Pose2 Drive(MecanumBase& dut, const PerWheel& speed, double seconds) {
  Pose2 pose;
  const double dt = 0.0025;
  for (int i = 0; i < seconds / dt; ++i) pose = Integrate(pose, dut.Step(speed, dt), dt);
  return pose;
}

TEST(MecanumBaseTest, EqualWheelsDriveForward) {
  MecanumBase dut(Ideal(), Rng(1));
  const Twist2 twist = dut.Step({5, 5, 5, 5}, 0.0025);
  EXPECT_NEAR(twist.vx, 0.5, 1e-12);
  EXPECT_NEAR(twist.vy, 0, 1e-12);
  EXPECT_NEAR(twist.wz, 0, 1e-12);
}

TEST(MecanumBaseTest, FrontRightAndRearLeftDriveToTheLeft) {
  MecanumBase dut(Ideal(), Rng(1));
  const Twist2 twist = dut.Step({-5, 5, 5, -5}, 0.0025);
  EXPECT_NEAR(twist.vx, 0, 1e-12);
  EXPECT_NEAR(twist.vy, 0.5, 1e-12);
  EXPECT_NEAR(twist.wz, 0, 1e-12);
}

TEST(MecanumBaseTest, RightWheelsForwardTurnCounterClockwise) {
  MecanumBase dut(Ideal(), Rng(1));
  const Twist2 twist = dut.Step({-6.2, 6.2, -6.2, 6.2}, 0.0025);
  EXPECT_NEAR(twist.vx, 0, 1e-12);
  EXPECT_NEAR(twist.vy, 0, 1e-12);
  EXPECT_NEAR(twist.wz, 1, 1e-12);
}

TEST(MecanumBaseTest, ContradictingWheelsOnlyScrub) {
  MecanumBase dut(Ideal(), Rng(1));
  const Twist2 twist = dut.Step({5, 5, -5, -5}, 0.0025);
  EXPECT_NEAR(std::hypot(twist.vx, twist.vy, twist.wz), 0, 1e-12);
}

TEST(MecanumBaseTest, WithTwoOrMoreLooseWheelsItIsNoFasterThanDrivenAndComesToRest) {
  for (const std::vector<std::size_t>& loose :
       {std::vector<std::size_t>{0}, {0, 3}, {0, 1}, {0, 2}, {1, 2, 3}, {0, 1, 2, 3}}) {
    MecanumBase dut(MecanumConfig{}, Rng(7));
    for (int i = 0; i < 400; ++i) dut.Step({5, 5, 5, 5}, 0.0025);
    for (const std::size_t wheel : loose) dut.Loosen(wheel);
    double fastest_m_s = 0;
    for (int i = 0; i < 4000; ++i) {
      const Twist2 twist = dut.Step({5, 5, 5, 5}, 0.0025);
      fastest_m_s = std::max(fastest_m_s, std::hypot(twist.vx, twist.vy));
    }
    EXPECT_LT(fastest_m_s, 0.6) << loose.size();
    Twist2 twist;
    for (int i = 0; i < 4000; ++i) twist = dut.Step({0, 0, 0, 0}, 0.0025);
    EXPECT_LT(std::hypot(twist.vx, twist.vy, twist.wz), 0.01) << loose.size();
  }
}

TEST(MecanumBaseTest, ThreeMetresStraightDriftInTheStatedBand) {
  std::vector<double> lateral, along, heading;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    MecanumBase dut(MecanumConfig{}, Rng(seed));
    const Pose2 end = Drive(dut, {5, 5, 5, 5}, 6);
    lateral.push_back(end.y);
    along.push_back(end.x - 3);
    heading.push_back(Degrees(end.yaw));
  }
  const auto rms = [](const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v * v;
    return std::sqrt(sum / static_cast<double>(values.size()));
  };
  // modules/world/FIGURES.md: about 1 % along, 1 % across, a quarter of a degree per metre; never perfect.
  EXPECT_GT(rms(lateral), 0.010);
  EXPECT_LT(rms(lateral), 0.045);
  EXPECT_GT(rms(along), 0.005);
  EXPECT_LT(rms(along), 0.030);
  EXPECT_GT(rms(heading), 0.3);
  EXPECT_LT(rms(heading), 1.5);
  EXPECT_LT(*std::max_element(lateral.begin(), lateral.end()), 0.15);
}

TEST(MecanumBaseTest, SidewaysMotionIsShortByTheLateralLoss) {
  MecanumConfig config = Ideal();
  config.lateral_loss = 0.05;
  double mean = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    MecanumBase dut(config, Rng(seed));
    mean += Drive(dut, {-5, 5, 5, -5}, 2).y / 100;
  }
  EXPECT_NEAR(mean, 1 - 0.025, 0.005);
}

TEST(MecanumBaseTest, AcceleratingWheelsSlipForward) {
  MecanumConfig config = Ideal();
  config.acceleration_slip_s2_m = 0.02;
  MecanumBase dut(config, Rng(1));
  dut.Step({5, 5, 5, 5}, 0.0025);
  // 5.0375 - 5 rad/s within 2.5 ms is 1.5 m/s^2 at the rim: 3 % slip.
  EXPECT_NEAR(dut.Step({5.0375, 5.0375, 5.0375, 5.0375}, 0.0025).vx, 0.50375 * 0.97, 1e-6);
}

TEST(MecanumBaseTest, WheelsThatAccelerateBackwardSlipBackward) {
  MecanumConfig config = Ideal();
  config.acceleration_slip_s2_m = 0.02;
  MecanumBase dut(config, Rng(1));
  dut.Step({-5, -5, -5, -5}, 0.0025);
  EXPECT_NEAR(dut.Step({-5.0375, -5.0375, -5.0375, -5.0375}, 0.0025).vx, -0.50375 * 0.97, 1e-6);
}

TEST(MecanumBaseTest, TheSlipKeepsItsSpreadHoweverFarItWanders) {
  MecanumConfig config = Ideal();
  config.roller_slip = 0.02;
  config.slip_length_m = 0.05;
  MecanumBase dut(config, Rng(3));
  double squares = 0;
  constexpr int kSteps = 40'000;
  for (int i = 0; i < kSteps; ++i) {
    const double slip = 1 - dut.Step({5, 5, 5, 5}, 0.0025).vx / 0.5;
    squares += slip * slip / kSteps;
  }
  // The mean of four wheels spreads half as much as one.
  EXPECT_NEAR(std::sqrt(squares), 0.02 / 2, 0.001);
}

TEST(MecanumBaseTest, SlipWandersWithTheWayNotWithTime) {
  MecanumConfig config = Ideal();
  config.roller_slip = 0.02;
  MecanumBase dut(config, Rng(3));
  const double before = dut.Step({1e-6, 1e-6, 1e-6, 1e-6}, 0.0025).vx;
  for (int i = 0; i < 1000; ++i) dut.Step({0, 0, 0, 0}, 0.0025);
  EXPECT_NEAR(dut.Step({1e-6, 1e-6, 1e-6, 1e-6}, 0.0025).vx, before, 1e-4 * before);
  Drive(dut, {5, 5, 5, 5}, 2);
  EXPECT_GT(std::abs(dut.Step({1e-6, 1e-6, 1e-6, 1e-6}, 0.0025).vx - before), 1e-3 * before);
}

TEST(MecanumBaseTest, TheSeedDecides) {
  MecanumBase a(MecanumConfig{}, Rng(7)), b(MecanumConfig{}, Rng(7)), c(MecanumConfig{}, Rng(8));
  const PerWheel speed{5, 5, 5, 5};
  EXPECT_EQ(Drive(a, speed, 1).y, Drive(b, speed, 1).y);
  EXPECT_NE(Drive(a, speed, 1).y, Drive(c, speed, 1).y);
}

}  // namespace
}  // namespace priamos::world
