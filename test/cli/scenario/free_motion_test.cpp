#include "cli/scenario/free_motion.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/robot/braking_law.hpp"

namespace priamos::cli {
namespace {

/// An upright box from the floor to above the robot.
world::Solid Box(double x_m, double y_m, double length_m, double width_m) {
  return {"box", {x_m, y_m, 0}, {length_m, width_m}, 0, 2, "wood"};
}

const world::Body kBody;
const double kFront_m = kBody.size_m.x() / 2;

/// The face of a wall so far ahead of the front of a base at the origin.
FreeMotion WithWallAhead(double distance_m) {
  return FreeMotion({kBody, {Box(kFront_m + distance_m + 0.5, 0, 1, 40)}});
}

Twist2 AnyWish() {
  const auto part = [](double largest) { return *rc::gen::inRange(-100, 101) * largest / 100; };
  return {part(0.8), part(0.8), part(1.0)};
}

TEST(FreeMotion, InAnEmptyWorldEveryWishIsFree) {
  const FreeMotion dut({kBody, {}});
  const Twist2 motion = dut.Of({3, -2, 1}, {0.6, -0.3, 0.5});
  EXPECT_EQ(motion.vx, 0.6);
  EXPECT_EQ(motion.vy, -0.3);
  EXPECT_EQ(motion.wz, 0.5);
}

TEST(FreeMotion, NoWishIsNoMotion) {
  const Twist2 motion = WithWallAhead(0.01).Of({}, {});
  EXPECT_EQ(std::abs(motion.vx) + std::abs(motion.vy) + std::abs(motion.wz), 0);
}

/// v t + v^2/2a shall be what is free of the way less the 20 cm that are kept.
TEST(FreeMotion, TowardsAWallTheSpeedIsWhatCanBeBraked) {
  const BrakingLaw braking{.deceleration_m_s2 = 1, .latency_s = 0.2};
  for (const double free_m : {0.1, 0.2, 0.4}) {
    const double v = WithWallAhead(0.20 + free_m).Of({}, {1.5, 0, 0}).vx;
    EXPECT_NEAR(v, braking.SpeedWithin(free_m), 0.03) << free_m;
  }
}

TEST(FreeMotion, NearerToTheWallIsNeverFaster) {
  double last = 0;
  for (double distance_m = 0.02; distance_m < 2; distance_m += 0.07) {
    const double v = WithWallAhead(distance_m).Of({}, {0.8, 0, 0}).vx;
    EXPECT_GE(v, last - 0.02) << distance_m;
    last = v;
  }
  EXPECT_NEAR(last, 0.8, 1e-9) << "two metres before it nothing limits";
}

TEST(FreeMotion, BesideABlockedWayTheRestOfTheWishIsFree) {
  const Twist2 motion = WithWallAhead(0.02).Of({}, {0.4, 0.3, 0});
  EXPECT_NEAR(motion.vx, 0, 0.02);
  EXPECT_NEAR(motion.vy, 0.3, 0.01) << "along the wall";
}

TEST(FreeMotion, AwayFromAWallIsFreeHoweverNearItIs) {
  EXPECT_NEAR(WithWallAhead(0.005).Of({}, {-0.5, 0, 0}).vx, -0.5, 1e-9);
}

TEST(FreeMotion, WhatLiesFlatOnTheFloorIsNoObstacle) {
  world::Solid threshold = Box(kFront_m + 0.1, 0, 0.05, 40);
  threshold.z_max_m = 0.01;
  EXPECT_NEAR(FreeMotion({kBody, {threshold}}).Of({}, {0.5, 0, 0}).vx, 0.5, 1e-9);
}

/// Along is a projection: of a wish onto itself it is the wish's own speed.
RC_GTEST_PROP(FreeMotion, AlongItselfAWishIsAsFastAsItsFastestCorner, ()) {
  const Twist2 wish = AnyWish();
  const double lever_m = kBody.size_m.norm() / 2;
  const Eigen::Vector3d w(wish.vx, wish.vy, wish.wz * lever_m);
  const FreeMotion dut({kBody, {}});
  RC_ASSERT(std::abs(dut.Along(wish, wish) - w.norm()) < 1e-12);
  const Twist2 back{-wish.vx, -wish.vy, -wish.wz};
  RC_ASSERT(std::abs(dut.Along(wish, back) + w.norm()) < 1e-12);
  RC_ASSERT(dut.Along({}, wish) == 0);
}

RC_GTEST_PROP(FreeMotion, EveryComponentLiesBetweenNoneAndTheWish, ()) {
  const Twist2 wish = AnyWish();
  const double distance_m = *rc::gen::inRange(1, 80) / 100.0;
  const Twist2 motion = WithWallAhead(distance_m).Of({}, wish);
  const auto between = [](double value, double wished) {
    return value * wished >= 0 && std::abs(value) <= std::abs(wished) + 1e-9;
  };
  RC_ASSERT(between(motion.vx, wish.vx));
  RC_ASSERT(between(motion.vy, wish.vy));
  RC_ASSERT(between(motion.wz, wish.wz));
}

/// A world mirrored at the x axis mirrors what is free in it.
RC_GTEST_PROP(FreeMotion, LeftAndRightAreAlike, ()) {
  const Twist2 wish = AnyWish();
  const double y_m = *rc::gen::inRange(60, 120) / 100.0;
  const Twist2 a = FreeMotion({kBody, {Box(0.5, y_m, 3, 0.2)}}).Of({}, wish);
  const Twist2 b = FreeMotion({kBody, {Box(0.5, -y_m, 3, 0.2)}}).Of({}, {wish.vx, -wish.vy, -wish.wz});
  RC_ASSERT(std::abs(a.vx - b.vx) < 1e-6);
  RC_ASSERT(std::abs(a.vy + b.vy) < 1e-6);
  RC_ASSERT(std::abs(a.wz + b.wz) < 1e-6);
}

}  // namespace
}  // namespace priamos::cli
