#include "world/core/scene/outline.hpp"

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
  return {{Length(-3, 3), Length(-3, 3), Length(-3.14, 3.14)}, {Length(0.01, 1.5), Length(0.01, 1.5)}};
}

TEST(OutlineTest, HasTheSolidsPoseAndSize) {
  const Rectangle dut = OutlineOf({"box", {1, 2, 0.5}, {0.4, 0.2}, 0, 1, "wood"});
  EXPECT_EQ(dut.map_from_centre.yaw, 0.5);
  EXPECT_EQ(dut.half_m, Eigen::Vector2d(0.2, 0.1));
}

TEST(OverlapsTest, HeightsThatOnlyTouchDoNotOverlap) {
  Solid threshold;
  threshold.z_max_m = 0.02;
  EXPECT_FALSE(Overlaps(threshold, 0.02, 1.35));
  threshold.z_max_m = 0.021;
  EXPECT_TRUE(Overlaps(threshold, 0.02, 1.35));
}

TEST(CastRayTest, HitsTheNearSideWithItsNormal) {
  const RayTarget box({{3, 0, 0}, {1, 1}});
  const auto dut = CastRay(box, {0, 0.5}, {1, 0}, 10);
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->distance_m, 2, 1e-12);
  EXPECT_TRUE(dut->normal.isApprox(Eigen::Vector2d(-1, 0)));
}

TEST(CastRayTest, MissesBesideBehindAndBeyondTheLimit) {
  const RayTarget box({{3, 0, 0}, {1, 1}});
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
  const auto dut = CastRay(RayTarget(box), origin, direction, 10);
  const double end = dut ? dut->distance_m : 10;
  for (int k = 0; k < 200; ++k) RC_ASSERT(Distance(box, origin + direction * end * k / 200) > 0);
  if (dut) {
    const Eigen::Vector2d local = box.ToLocal(origin + direction * end).cwiseAbs() - box.half_m;
    RC_ASSERT(std::abs(local.maxCoeff()) < 1e-9);
    RC_ASSERT(dut->normal.dot(direction) < 0);
  }
}

}  // namespace
}  // namespace priamos::world
