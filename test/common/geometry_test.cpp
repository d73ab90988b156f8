#include "common/geometry.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace priamos {
namespace {

double Real(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}
Pose2 AnyPose() {
  return {Real(-50, 50), Real(-50, 50), Real(-3.1, 3.1)};
}

TEST(Geometry, WrapAngleKeepsPiAndMapsMinusPiToIt) {
  EXPECT_DOUBLE_EQ(WrapAngle(kPi), kPi);
  EXPECT_DOUBLE_EQ(WrapAngle(-kPi), kPi);
  EXPECT_NEAR(WrapAngle(3 * kPi / 2), -kPi / 2, 1e-12);
}

TEST(Geometry, TransformOfAPointGoesCounterClockwise) {
  const Pose2 map_from_base{1, 2, kPi / 2};
  const Eigen::Vector2d in_map = map_from_base * Eigen::Vector2d(1, 0);
  EXPECT_NEAR(in_map.x(), 1, 1e-12);
  EXPECT_NEAR(in_map.y(), 3, 1e-12);
}

RC_GTEST_PROP(Geometry, InverseUndoesAPose, ()) {
  const Pose2 p = AnyPose();
  const Pose2 identity = p * p.Inverse();
  RC_ASSERT(identity.translation().norm() < 1e-9);
  RC_ASSERT(std::abs(WrapAngle(identity.yaw)) < 1e-9);
}

RC_GTEST_PROP(Geometry, IntegrateEqualsManySmallSteps, ()) {
  const Twist2 twist{Real(-1, 1), Real(-1, 1), Real(-1, 1)};
  const Pose2 whole = Integrate({}, twist, 1.0);
  Pose2 small;
  for (int i = 0; i < 1000; ++i) small = Integrate(small, twist, 1e-3);
  RC_ASSERT((whole.translation() - small.translation()).norm() < 1e-8);
  RC_ASSERT(std::abs(WrapAngle(whole.yaw - small.yaw)) < 1e-9);
}

TEST(Geometry, IntegrateAQuarterCircle) {
  const Pose2 dut = Integrate({}, {kPi / 2, 0, kPi / 2}, 1.0);  // radius 1 m
  EXPECT_NEAR(dut.x, 1, 1e-12);
  EXPECT_NEAR(dut.y, 1, 1e-12);
  EXPECT_NEAR(dut.yaw, kPi / 2, 1e-12);
}

}  // namespace
}  // namespace priamos
