#include "robot/core/features/feature.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>

namespace priamos::robot {
namespace {

/// A wall 1.5 m to the left of a base at the origin of the odometry, heard just before.
HeardFeature Wall(const Whereabouts& heard_at) {
  HeardFeature wall;
  wall.line = {.angle_rad = kPi / 2, .distance_m = 1.5};
  wall.line.covariance = Eigen::Vector2d(1e-5, 1e-5).asDiagonal();
  wall.from = {1, 1.5};
  wall.to = {-1, 1.5};
  wall.heard_at = heard_at;
  return wall;
}

Whereabouts Base(const Pose2& map_from_base, double sigma_m, double sigma_rad) {
  return {map_from_base,
          Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal(),
          {},
          0};
}

TEST(InMap, LiesBesideTheBaseWithTheBaseToItsLeft) {
  const Whereabouts base = Base({5, 2, kPi / 2}, 0.01, 0.01);
  const Feature dut = InMap(7, Wall(base), base, {});
  EXPECT_EQ(dut.id, 7);
  EXPECT_NEAR(dut.map_from_middle.x, 3.5, 1e-9);
  EXPECT_NEAR(dut.map_from_middle.y, 2, 1e-9);
  EXPECT_NEAR((dut.map_from_middle.Inverse() * base.map_from_base).y, 1.5, 1e-9);
  EXPECT_NEAR(dut.length_m, 2, 1e-9);
}

TEST(InMap, TheUncertaintyOfThePoseIsThatOfTheWall) {
  const Whereabouts base = Base({5, 2, 0}, 0.1, 0.05);
  const Feature dut = InMap(1, Wall(base), base, {});
  EXPECT_NEAR(dut.covariance(0, 0), 0.01 + 1e-5, 1e-6);
  EXPECT_NEAR(dut.covariance(1, 1), 0.0025 + 1e-5, 1e-6);
}

TEST(InMap, AFixMendsWhatWasHeardBefore) {
  const Whereabouts then = Base({5, 2, 0.05}, 0.1, 0.05);
  Whereabouts now = Base({5.95, 2, 0}, 0.01, 0.004);
  now.odom_from_base = {1, 0, 0};
  now.travel_m = 1;
  const Feature dut = InMap(1, Wall(then), now, {});
  EXPECT_NEAR(dut.map_from_middle.y, 3.5, 1e-9);
  EXPECT_NEAR(dut.map_from_middle.x, 4.95, 1e-9);
  EXPECT_GT(dut.covariance(1, 1), 0.004 * 0.004) << "and carries what the wheels lost since then";
  now.travel_m = 1000;
  EXPECT_NEAR(InMap(1, Wall(then), now, {}).map_from_middle.yaw, WrapAngle(kPi + 0.05), 1e-9)
      << "after a long drive the pose of then tells more";
}

RC_GTEST_PROP(InMap, TheCovarianceIsOne, ()) {
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) / 100.0; };
  const Whereabouts then = Base({number(), number(), number()}, 0.2, 0.1);
  Whereabouts now = Base({number(), number(), number()}, 0.1, 0.1);
  now.odom_from_base = {number(), number(), number()};
  now.travel_m = *rc::gen::inRange(0, 100);
  const Eigen::Matrix2d dut = InMap(1, Wall(then), now, {}).covariance;
  RC_ASSERT(std::abs(dut(0, 1) - dut(1, 0)) < 1e-9);
  RC_ASSERT(dut.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 0);
}

}  // namespace
}  // namespace priamos::robot
