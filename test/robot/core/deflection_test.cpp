#include "robot/core/deflection.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

namespace priamos::robot {
namespace {

using Points = std::vector<Eigen::Vector2d>;

const DeflectionConfig kConfig{.gap_m = 0.05, .braking_m_s2 = 0.6, .latency_s = 0.2, .reach_m = 1.0};

Twist2 Deflect(const Twist2& wanted, const Points& points) {
  return Deflected(kConfig, Footprint{}, wanted, points);
}

/// A wall ahead at `distance` from the front.
Points WallAhead(double distance) {
  Points points;
  for (double y = -1; y <= 1; y += 0.05) points.push_back({0.475 + distance, y});
  return points;
}

TEST(Deflection, LeavesTheWishAloneWhereNothingIsNear) {
  const Twist2 dut = Deflect({0.5, 0.2, 0.3}, {{3, 0}});
  EXPECT_EQ(dut.vx, 0.5);
  EXPECT_EQ(dut.wz, 0.3);
}

TEST(Deflection, PushingStraightIntoAWallStops) {
  EXPECT_NEAR(Deflect({0.5, 0, 0}, WallAhead(0.05)).vx, 0, 1e-3);
}

TEST(Deflection, PushingIntoAWallAtASlantSlidesAlongIt) {
  const Twist2 dut = Deflect({0.4, 0.3, 0}, WallAhead(0.05));
  EXPECT_NEAR(dut.vx, 0, 1e-2);
  EXPECT_NEAR(dut.vy, 0.3, 1e-2);
}

TEST(Deflection, MotionAwayIsNotLimited) {
  const Twist2 dut = Deflect({-0.5, 0, 0}, WallAhead(0.01));
  EXPECT_NEAR(dut.vx, -0.5, 1e-9);
}

TEST(Deflection, SlowsDownGraduallyWithTheDistance) {
  double before = 0.5;
  for (double distance = 0.9; distance > 0.05; distance -= 0.02) {
    const double v = Deflect({0.5, 0, 0}, WallAhead(distance)).vx;
    EXPECT_LE(v, before + 1e-6);
    EXPECT_LE(v * 0.2 + v * v / 1.2, distance - 0.05 + 1e-3) << "stops in the free way";
    before = v;
  }
  EXPECT_LT(before, 0.1);
}

TEST(Deflection, TurningBesideAWallIsLimitedAtTheCorners) {
  Points beside;
  for (double x = -1; x <= 1; x += 0.05) beside.push_back({x, 0.39 + 0.06});
  EXPECT_LT(std::abs(Deflect({0, 0, 0.6}, beside).wz), 0.2);
  const Twist2 along = Deflect({0.4, 0, 0}, beside);
  EXPECT_NEAR(along.vx, 0.4, 1e-2) << "driving along it is not";
}

TEST(Deflection, InventsNoMotionThatWasNotWished) {
  EXPECT_TRUE(rc::check([] {
    const auto part = [](double most) { return *rc::gen::inRange(-1000, 1001) / 1000.0 * most; };
    Points points;
    for (int i = 0; i < 6; ++i) points.push_back({part(1.2), part(1.2)});
    const Twist2 wish{part(0.6), part(0.6), part(0.6)};
    const Twist2 dut = Deflect(wish, points);
    for (const auto& [given, wished] :
         {std::pair(dut.vx, wish.vx), std::pair(dut.vy, wish.vy), std::pair(dut.wz, wish.wz)}) {
      RC_ASSERT(given * wished >= -1e-3);
      RC_ASSERT(std::abs(given) <= std::abs(wished) + 1e-3);
    }
  }));
}

TEST(Deflection, ApproachesNoPointFasterThanAllowed) {
  EXPECT_TRUE(rc::check([] {
    const auto part = [](double most) { return *rc::gen::inRange(-1000, 1001) / 1000.0 * most; };
    Points points;
    for (int i = 0; i < 6; ++i) points.push_back({part(1.2), part(1.2)});
    const Footprint footprint;
    for (const auto& point : points) RC_PRE(footprint.Distance(point) > 0.01);
    const Twist2 dut = Deflect({part(0.6), part(0.6), part(0.6)}, points);
    for (const auto& point : points) {
      const Eigen::Vector2d q = footprint.Nearest(point), way = point - q;
      if (way.norm() > 1.0) continue;
      // Along at least one axis the footprint stops before the point.
      const auto keeps = [&](double distance, double approach) {
        if (distance == 0) return false;
        const double free = std::max(0.0, std::abs(distance) - 0.05);
        return std::copysign(1.0, distance) * approach <= std::sqrt(0.0144 + 1.2 * free) - 0.12 + 0.02;
      };
      RC_ASSERT(keeps(way.x(), dut.vx - dut.wz * q.y()) || keeps(way.y(), dut.vy + dut.wz * q.x()));
    }
  }));
}

}  // namespace
}  // namespace priamos::robot
