#include "robot/core/motion/deflection.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "robot/core/safety/collision_stop.hpp"

namespace priamos::robot {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// The filter as an operator meets it.
const CollisionStop kGuard{{.margin_m = 0.055, .memory_margin_m = 0.01}, Footprint{}};
const double kReach = Footprint{}.Reach();

Twist2 Deflect(const Twist2& wanted, const Points& seen, const Points& remembered = {}) {
  return Deflected(wanted, kReach,
                   [&](const Twist2& motion) { return kGuard.Scale(motion, seen, remembered); });
}

/// How far `motion` comes along `wish`, in parts of the wish.
double Progress(const Twist2& wish, const Twist2& motion) {
  const Eigen::Vector3d w(wish.vx, wish.vy, wish.wz * kReach), m(motion.vx, motion.vy, motion.wz * kReach);
  return m.dot(w) / w.squaredNorm();
}

/// A wall ahead at `distance` from the front, from the right to `left_end`.
Points WallAhead(double distance, double left_end = 1) {
  Points points;
  for (double y = -1; y <= left_end; y += 0.02) points.push_back({0.475 + distance, y});
  return points;
}

double Part(double most) {
  return *rc::gen::inRange(-1000, 1001) / 1000.0 * most;
}

/// At most `count` points round the base, none within its body.
Points Around(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d point(Part(1.2), Part(1.2));
    if (Footprint{}.Distance(point) > 0) points.push_back(point);
  }
  return points;
}

TEST(Deflection, LeavesTheWishAloneWhereNothingIsNear) {
  const Twist2 dut = Deflect({0.5, 0.2, 0.3}, {{3, 0}});
  EXPECT_EQ(dut.vx, 0.5);
  EXPECT_EQ(dut.vy, 0.2);
  EXPECT_EQ(dut.wz, 0.3);
}

TEST(Deflection, PushingStraightIntoAWallStops) {
  EXPECT_NEAR(Deflect({0.5, 0, 0}, WallAhead(0.15)).vx, 0, 1e-3);
}

TEST(Deflection, PushingIntoAWallAtASlantSlidesAlongItFromAnyDistance) {
  for (double distance = 0.06; distance < 0.4; distance += 0.01) {
    const Twist2 dut = Deflect({0.4, 0.3, 0}, WallAhead(distance));
    EXPECT_GT(dut.vy, 0.25) << distance;
  }
}

/// What an operator met before a carton: 12 cm before its face, its end 20 cm to the left of the middle, the
/// wish mostly ahead. The way to the left is free.
TEST(Deflection, BeforeACartonTheFreePartOfTheWishLeadsPastIt) {
  EXPECT_GT(Deflect({0.47, 0.17, 0}, WallAhead(0.122, 0.2)).vy, 0.15);
}

TEST(Deflection, ARememberedThingDeflectsLikeOneThatIsSeen) {
  const Twist2 dut = Deflect({0.47, 0.17, 0}, {}, {{0.475 + 0.05, -0.2}});
  EXPECT_GT(dut.vy, 0.15);
}

TEST(Deflection, MotionAwayIsNotLimited) {
  EXPECT_EQ(Deflect({-0.5, 0, 0}, WallAhead(0.01)).vx, -0.5);
}

TEST(Deflection, SlowsDownGraduallyWithTheDistance) {
  double before = 0.5;
  for (double distance = 0.9; distance > 0.19; distance -= 0.02) {
    const double v = Deflect({0.5, 0, 0}, WallAhead(distance)).vx;
    EXPECT_LE(v, before + 1e-6);
    EXPECT_GT(v, before - 0.13);
    before = v;
  }
  EXPECT_LT(before, 0.1);
}

TEST(Deflection, TurningBesideAWallIsLimitedAtTheCorners) {
  Points beside;
  for (double x = -1; x <= 1; x += 0.05) beside.push_back({x, 0.39 + 0.06});
  EXPECT_LT(std::abs(Deflect({0, 0, 0.6}, beside).wz), 0.1);
  const Twist2 along = Deflect({0.4, 0, 0.2}, beside);
  EXPECT_NEAR(along.vx, 0.4, 1e-2) << "driving along it is not";
}

TEST(Deflection, InventsNoMotionThatWasNotWished) {
  EXPECT_TRUE(rc::check([] {
    const Twist2 wish{Part(0.6), Part(0.6), Part(0.6)};
    const Twist2 dut = Deflect(wish, Around(6));
    for (const auto& [given, wished] :
         {std::pair(dut.vx, wish.vx), std::pair(dut.vy, wish.vy), std::pair(dut.wz, wish.wz)}) {
      RC_ASSERT(given * wished >= 0);
      RC_ASSERT(std::abs(given) <= std::abs(wished));
    }
  }));
}

/// The filter that comes afterwards has nothing left to take away. Where the two disagreed the base stood for
/// good: deflection went on asking for a motion that was then scaled to nothing.
TEST(Deflection, WhatItFindsTheCollisionStopLetsPass) {
  EXPECT_TRUE(rc::check([] {
    const Points seen = Around(6), remembered = Around(2);
    const Twist2 dut = Deflect({Part(0.6), Part(0.6), Part(0.6)}, seen, remembered);
    RC_ASSERT(kGuard.Limit(dut, seen, remembered).scale > 0.99);
  }));
}

/// A search for the farthest motion uses up whatever a filter tolerates, step by step: a monkey at the stick
/// crept up to an armchair in this way.
TEST(Deflection, HalfOfTheMarginStaysFreeHoweverLongOneSlides) {
  EXPECT_TRUE(rc::check([] {
    Points seen;
    for (const Eigen::Vector2d& point : Around(20))
      if (Footprint{}.Distance(point) > 0.03) seen.push_back(point);
    const Twist2 wish{Part(0.6), Part(0.6), Part(0.6)};
    Pose2 base;
    for (int i = 0; i < 200; ++i) {
      Points now;
      for (const Eigen::Vector2d& point : seen) now.push_back(base.Inverse() * point);
      base = Integrate(base, Deflect(wish, now), 0.02);
    }
    for (const Eigen::Vector2d& point : seen) RC_ASSERT(Footprint{}.Distance(base.Inverse() * point) > 0.025);
  }));
}

TEST(Deflection, StandsOnlyWhereNoPartOfTheWishIsFree) {
  EXPECT_TRUE(rc::check([] {
    const Points seen = Around(6);
    const Twist2 wish{Part(0.6), Part(0.6), Part(0.6)};
    RC_PRE(std::hypot(wish.vx, wish.vy) > 0.05);
    const double found = Progress(wish, Deflect(wish, seen));
    for (double x = 0; x <= 1; x += 0.125)
      for (double y = 0; y <= 1; y += 0.125)
        for (double turn = 0; turn <= 1; turn += 0.125) {
          const Twist2 other{x * wish.vx, y * wish.vy, turn * wish.wz};
          RC_ASSERT(found > 0.3 * kGuard.Scale(other, seen, {}) * Progress(wish, other) - 0.02);
        }
  }));
}

}  // namespace
}  // namespace priamos::robot
