#include "robot/core/twist_slew.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kDt = 0.02;

TEST(TwistSlew, ReachesTheTargetInStepsOfTheLimit) {
  TwistSlew dut({.acceleration_m_s2 = 0.5, .turn_acceleration_rad_s2 = 1});
  EXPECT_NEAR(dut.Step({0.4, 0, 0.5}, kDt).vx, 0.01, 1e-12);
  EXPECT_NEAR(dut.commanded().wz, 0.0125, 1e-12);
  for (int i = 0; i < 60; ++i) dut.Step({0.4, 0, 0.5}, kDt);
  EXPECT_NEAR(std::hypot(dut.commanded().vx, dut.commanded().vy - 0), 0.4, 0.01);
  EXPECT_NEAR(dut.commanded().wz, 0.5, 1e-12);
}

TEST(TwistSlew, LimitsTheVectorNotItsParts) {
  TwistSlew dut({.acceleration_m_s2 = 0.5, .turn_acceleration_rad_s2 = 1});
  const Twist2 first = dut.Step({1, 1, 0}, kDt);
  EXPECT_NEAR(std::hypot(first.vx, first.vy), 0.01, 1e-12);
}

TEST(TwistSlew, ABaseThatSetsOffDoesSoInTheDirectionOfTheTarget) {
  for (const Twist2& target : {Twist2{0.4, 0.1, 0.05}, Twist2{0.05, -0.1, 0.6}, Twist2{0.3, 0, -0.6}}) {
    TwistSlew dut({.acceleration_m_s2 = 0.5, .turn_acceleration_rad_s2 = 1});
    const Twist2 first = dut.Step(target, kDt);
    const double part = first.vx / target.vx;
    EXPECT_NEAR(first.vy, part * target.vy, 1e-12);
    EXPECT_NEAR(first.wz, part * target.wz, 1e-12);
    EXPECT_NEAR(std::max(std::hypot(first.vx, first.vy) / 0.01, std::abs(first.wz) / 0.02), 1, 1e-9);
  }
}

TEST(TwistSlew, DrivingStraightOverTheFloorWhileTurningIsNoAcceleration) {
  TwistSlew dut({.acceleration_m_s2 = 0.05, .turn_acceleration_rad_s2 = 1});
  dut.SetCommanded({0.5, 0, 0.5});
  double yaw = 0;
  for (int i = 0; i < 100; ++i) {
    yaw += 0.5 * kDt;
    const Twist2 target{0.5 * std::cos(yaw), -0.5 * std::sin(yaw), 0.5};
    const Twist2 got = dut.Step(target, kDt);
    EXPECT_NEAR(got.vx, target.vx, 1e-9);
    EXPECT_NEAR(got.vy, target.vy, 1e-9);
  }
}

TEST(TwistSlew, GoesOnFromWhatALaterFilterLeft) {
  TwistSlew dut({.acceleration_m_s2 = 0.5, .turn_acceleration_rad_s2 = 1});
  dut.SetCommanded({0.4, 0, 0});
  dut.SetCommanded({0.1, 0, 0});
  EXPECT_NEAR(dut.Step({0.4, 0, 0}, kDt).vx, 0.11, 1e-12);
}

}  // namespace
}  // namespace priamos::robot
