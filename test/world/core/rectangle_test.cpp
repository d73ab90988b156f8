#include "world/core/rectangle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace priamos::world {
namespace {

/// Numbers of a size that occurs in rooms, with enough coincidences to hit touching and parallel cases.
double Length(double low, double high) {
  return *rc::gen::inRange(static_cast<int>(low * 100), static_cast<int>(high * 100)) / 100.0;
}

Rectangle AnyRectangle() {
  return {{Length(-3, 3), Length(-3, 3), Length(-3.14, 3.14)}, {Length(0.02, 3), Length(0.02, 3)}};
}

/// Distance by walking over the outline of a in small steps; `spacing` bounds its error.
double BruteForceDistance(const Rectangle& a, const Rectangle& b, double spacing) {
  double nearest = std::min(Distance(b, a.centre), Distance(a, b.centre));
  const auto corners = a.Corners();
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d from = corners[i], way = corners[(i + 1) % 4] - from;
    const int n = static_cast<int>(way.norm() / spacing) + 1;
    for (int k = 0; k <= n; ++k) nearest = std::min(nearest, Distance(b, from + way * k / n));
  }
  return nearest;
}

TEST(RectangleTest, CornersAreCounterClockwise) {
  const Rectangle dut({1, 2, kPi / 2}, {4, 2});
  const auto corners = dut.Corners();
  EXPECT_TRUE(corners[0].isApprox(Eigen::Vector2d(0, 4)));
  EXPECT_TRUE(corners[1].isApprox(Eigen::Vector2d(0, 0), 1e-12) || corners[1].norm() < 1e-12);
  EXPECT_TRUE(corners[2].isApprox(Eigen::Vector2d(2, 0)));
  EXPECT_TRUE(corners[3].isApprox(Eigen::Vector2d(2, 4)));
}

TEST(RectangleTest, PointInsideHasDistanceZero) {
  EXPECT_EQ(Distance(Rectangle({0, 0, 0.3}, {1, 1}), Eigen::Vector2d(0.1, -0.2)), 0);
}

TEST(RectangleTest, CrossingRectanglesHaveDistanceZeroThoughNoCornerIsInside) {
  EXPECT_EQ(Distance(Rectangle({0, 0, 0}, {4, 0.2}), Rectangle({0, 0, kPi / 2}, {4, 0.2})), 0);
}

TEST(RectangleTest, ParallelSidesGiveTheirSpacing) {
  EXPECT_NEAR(Distance(Rectangle({0, 0, 0}, {1, 1}), Rectangle({1.25, 0.3, 0}, {1, 1})), 0.25, 1e-12);
}

RC_GTEST_PROP(RectangleProperty, DistanceEqualsBruteForce, ()) {
  const Rectangle a = AnyRectangle(), b = AnyRectangle();
  const double dut = Distance(a, b);
  // The least distance lies on the outline of both, unless one contains the other.
  const double outline = BruteForceDistance(a, b, 0.005);
  RC_ASSERT(dut <= outline + 1e-9);
  RC_ASSERT(dut >= outline - 0.005);
}

RC_GTEST_PROP(RectangleProperty, DistanceIsSymmetricAndMovesWithTheFrame, ()) {
  const Rectangle a = AnyRectangle(), b = AnyRectangle();
  const Pose2 moved{Length(-5, 5), Length(-5, 5), Length(-3, 3)};
  const auto move = [&](Rectangle r) {
    r.centre = moved * r.centre;
    r.axis_x = moved.rotation() * r.axis_x;
    return r;
  };
  RC_ASSERT(std::abs(Distance(a, b) - Distance(b, a)) < 1e-12);
  RC_ASSERT(std::abs(Distance(a, b) - Distance(move(a), move(b))) < 1e-9);
}

TEST(CastRayTest, HitsTheNearSideWithItsNormal) {
  const Rectangle box({3, 0, 0}, {2, 2});
  const auto dut = CastRay(box, {0, 0.5}, {1, 0}, 10);
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->distance_m, 2, 1e-12);
  EXPECT_TRUE(dut->normal.isApprox(Eigen::Vector2d(-1, 0)));
}

TEST(CastRayTest, MissesBesideBehindAndBeyondTheLimit) {
  const Rectangle box({3, 0, 0}, {2, 2});
  EXPECT_FALSE(CastRay(box, {0, 1.5}, {1, 0}, 10));
  EXPECT_FALSE(CastRay(box, {0, 0}, {-1, 0}, 10));
  EXPECT_FALSE(CastRay(box, {0, 0}, {1, 0}, 1.9));
}

RC_GTEST_PROP(CastRayProperty, TheHitLiesOnTheOutlineAndNothingBeforeItIsInside, ()) {
  const Rectangle box = AnyRectangle();
  const Eigen::Vector2d origin(Length(-3, 3), Length(-3, 3));
  RC_PRE(Distance(box, origin) > 1e-6);
  const double bearing = Length(-3.14, 3.14);
  const Eigen::Vector2d direction(std::cos(bearing), std::sin(bearing));
  const auto dut = CastRay(box, origin, direction, 10);
  const double end = dut ? dut->distance_m : 10;
  for (int k = 0; k < 200; ++k) RC_ASSERT(Distance(box, origin + direction * end * k / 200) > 0);
  if (dut) {
    const Eigen::Vector2d local = box.ToLocal(origin + direction * end).cwiseAbs() - box.half;
    RC_ASSERT(std::abs(local.maxCoeff()) < 1e-9);
    RC_ASSERT(dut->normal.dot(direction) < 0);
  }
}

TEST(OverlapsTest, HeightsThatOnlyTouchDoNotOverlap) {
  Solid threshold;
  threshold.z_max_m = 0.02;
  EXPECT_FALSE(Overlaps(threshold, 0.02, 1.35));
  threshold.z_max_m = 0.021;
  EXPECT_TRUE(Overlaps(threshold, 0.02, 1.35));
}

}  // namespace
}  // namespace priamos::world
