#include "head/core/camera/laser_plane.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;

Vector3d AnyDirection() {
  const double azimuth = Between(-3.1, 3.1), height = Between(-0.95, 0.95),
               ring = std::sqrt(1 - height * height);
  return {ring * std::cos(azimuth), ring * std::sin(azimuth), height};
}

RC_GTEST_PROP(LaserPlaneTest, InTheCameraItIsAsFarFromEveryPoint, ()) {
  LaserPlane dut;
  dut.normal = AnyDirection();
  dut.offset_m = Between(-1, 1);
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  base_from_camera.translation() = Vector3d(Between(-1, 1), Between(-1, 1), Between(0, 2));
  base_from_camera.linear() = Eigen::AngleAxisd(Between(-3, 3), AnyDirection()).toRotationMatrix();
  const Vector3d in_base(Between(-3, 3), Between(-3, 3), Between(-1, 2));
  const auto in_camera = dut.InCamera(base_from_camera);
  RC_ASSERT(std::abs(in_camera.normal().norm() - 1) < 1e-9);
  RC_ASSERT(std::abs(in_camera.signedDistance(base_from_camera.inverse() * in_base) -
                     dut.Plane().signedDistance(in_base)) < 1e-9);
  RC_ASSERT(std::abs(dut.Plane().signedDistance(in_base) - dut.normal.dot(in_base) - dut.offset_m) < 1e-9);
}

RC_GTEST_PROP(PointOnPlaneTest, IsThePointThatTheCameraShowsThere, ()) {
  CameraModel camera = test::HeadCamera(Between(-0.3, 0.3), 1, 900, Between(-0.2, 0.1));
  camera.image_from_base *= Between(0.1, 5);  // a DLT matrix has any scale
  const Vector3d seen(Between(2, 5), Between(-0.3, 0.3), Between(0.8, 1.6)), normal = AnyDirection();
  const Vector3d sight = (seen - Vector3d(0.25, 0.15, 1.2)).normalized();
  RC_PRE(std::abs(normal.dot(sight)) > 0.15);
  const auto dut =
      PointOnPlane(camera, camera.Distort(camera.Project(seen)), Eigen::Hyperplane<double, 3>(normal, seen));
  RC_ASSERT(dut.has_value());
  RC_ASSERT((*dut - seen).norm() < 1e-6);
}

TEST(PointOnPlaneTest, APlaneBehindTheCameraIsNotSeen) {
  const CameraModel camera = test::HeadCamera(0, 0);
  const Vector2d middle(383.5, 290);
  EXPECT_TRUE(PointOnPlane(camera, middle, {Vector3d::UnitX(), -2.0}));
  EXPECT_FALSE(PointOnPlane(camera, middle, {Vector3d::UnitX(), 2.0}));
  EXPECT_TRUE(PointOnPlane(camera, middle, {-Vector3d::UnitX(), 2.0})) << "either side may face the camera";
}

TEST(PointOnPlaneTest, APlaneSeenEdgeOnIsNotSeen) {
  const CameraModel camera = test::HeadCamera(0, 0);
  const Vector2d middle(383.5, 290);  // along x
  const auto leaning = [](double sine) {
    return Eigen::Hyperplane<double, 3>(Vector3d(-sine, 0, std::sqrt(1 - sine * sine)), 0.0);
  };
  EXPECT_FALSE(PointOnPlane(camera, middle, leaning(0)));
  EXPECT_FALSE(PointOnPlane(camera, middle, leaning(0.019)));
  EXPECT_TRUE(PointOnPlane(camera, middle, leaning(0.021)));
}

TEST(PointOnPlaneTest, WhatIsNoNumberIsNoPoint) {
  const CameraModel camera = test::HeadCamera(0, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(PointOnPlane(camera, {nan, 290}, {Vector3d::UnitX(), -2.0}));
  EXPECT_FALSE(PointOnPlane(camera, {383.5, 290}, {Vector3d(nan, 0, 0), -2.0}));
}

}  // namespace
}  // namespace priamos::head
