#include "robot/core/base/mecanum.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

const MecanumGeometry kGeometry{.wheel_radius_m = 0.1, .lever_m = 0.5, .max_wheel_rad_s = 10};

Twist2 AnyTwist() {
  const auto part = [] { return *rc::gen::inRange(-1500, 1501) / 1000.0; };
  return {part(), part(), part()};
}

TEST(Mecanum, ForwardTurnsAllWheelsForward) {
  EXPECT_THAT(ToWheelSpeeds(kGeometry, {0.5, 0, 0}), ElementsAre(5, 5, 5, 5));
}

TEST(Mecanum, LeftwardPushesWithFrontRightAndRearLeft) {
  EXPECT_THAT(ToWheelSpeeds(kGeometry, {0, 0.5, 0}), ElementsAre(-5, 5, 5, -5));
}

TEST(Mecanum, CounterClockwiseTurnsTheRightSideForward) {
  EXPECT_THAT(ToWheelSpeeds(kGeometry, {0, 0, 1}), ElementsAre(-5, 5, -5, 5));
}

TEST(Mecanum, RoundTripKeepsEveryTwistAndShowsNoSlip) {
  EXPECT_TRUE(rc::check([] {
    const Twist2 twist = AnyTwist();
    const WheelMotion motion = FromWheelSpeeds(kGeometry, ToWheelSpeeds(kGeometry, twist));
    RC_ASSERT(std::abs(motion.twist.vx - twist.vx) < 1e-12);
    RC_ASSERT(std::abs(motion.twist.vy - twist.vy) < 1e-12);
    RC_ASSERT(std::abs(motion.twist.wz - twist.wz) < 1e-12);
    RC_ASSERT(std::abs(motion.slip_m_s) < 1e-12);
  }));
}

TEST(Mecanum, OneSpinningWheelShowsAsSlip) {
  WheelSpeeds speeds = ToWheelSpeeds(kGeometry, {0.5, 0, 0});
  speeds[1] += 4;
  EXPECT_THAT(FromWheelSpeeds(kGeometry, speeds).slip_m_s, DoubleNear(0.1, 1e-12));
}

TEST(Mecanum, SaturationKeepsTheDirectionOfTheTwist) {
  EXPECT_TRUE(rc::check([] {
    const Twist2 twist = AnyTwist();
    const WheelSpeeds limited = Saturated(kGeometry, ToWheelSpeeds(kGeometry, twist));
    for (const double speed : limited) RC_ASSERT(std::abs(speed) <= kGeometry.max_wheel_rad_s + 1e-9);
    const Twist2 kept = FromWheelSpeeds(kGeometry, limited).twist;
    RC_ASSERT(std::abs(kept.vx * twist.vy - kept.vy * twist.vx) < 1e-9);
    RC_ASSERT(std::abs(kept.vx * twist.wz - kept.wz * twist.vx) < 1e-9);
    RC_ASSERT(kept.vx * twist.vx + kept.vy * twist.vy + kept.wz * twist.wz >= 0);
  }));
}

TEST(Mecanum, SaturationLeavesSlowWheelsAlone) {
  EXPECT_THAT(Saturated(kGeometry, {1, -2, 3, 10}), ElementsAre(1, -2, 3, 10));
}

}  // namespace
}  // namespace priamos::robot
