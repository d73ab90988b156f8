#include "head/core/camera/camera_model.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

/// 1000 px, at (0.25, 0, 1.2) in the base frame, looking along x: u grows to the right (-y), v down (-z).
CameraModel LookingForward() {
  CameraModel dut;
  Eigen::Matrix3d k;
  k << 1000, 0, 384, 0, 1000, 288, 0, 0, 1;
  Eigen::Matrix<double, 3, 4> extrinsics;
  extrinsics << 0, -1, 0, 0, 0, 0, -1, 1.2, 1, 0, 0, -0.25;
  dut.image_from_base = k * extrinsics;
  return dut;
}

TEST(CameraModel, ProjectsByEquations5And6) {
  const CameraModel dut = LookingForward();
  const Eigen::Vector2d px = dut.Project({2.25, 0.2, 1.1});
  EXPECT_NEAR(px.x(), 384 - 100, 1e-9);  // left of the axis
  EXPECT_NEAR(px.y(), 288 + 50, 1e-9);   // below the axis
}

TEST(CameraModel, DepthIsPositiveBeforeTheCameraAndInMetres) {
  const CameraModel dut = LookingForward();
  EXPECT_NEAR(dut.Depth({2.25, 0.2, 1.1}), 2.0, 1e-12);
  EXPECT_LT(dut.Depth({-1, 0, 1}), 0);
}

TEST(CameraModel, BarrelDistortionPullsTowardsTheCentre) {
  CameraModel dut = LookingForward();
  dut.k1 = -0.1;
  const Eigen::Vector2d corner(0, 0);
  EXPECT_LT((dut.Distort(corner) - dut.centre_px).norm(), (corner - dut.centre_px).norm());
  EXPECT_NEAR((dut.Distort(dut.centre_px) - dut.centre_px).norm(), 0, 1e-12);
}

TEST(CameraModel, UndistortInvertsDistortOverTheWholeImage) {
  CameraModel dut = LookingForward();
  dut.centre_px = {370, 300};
  for (const double k1 : {-0.2, 0.0, 0.15}) {
    dut.k1 = k1;
    dut.k2 = 0.05;
    for (double u = -20; u <= 790; u += 90) {
      for (double v = -20; v <= 600; v += 62) {
        const Eigen::Vector2d px(u, v);
        EXPECT_LT((dut.Undistort(dut.Distort(px)) - px).norm(), 1e-9) << k1 << " " << u << " " << v;
      }
    }
  }
}

TEST(CameraModel, UndistortStaysFiniteBeyondTheTurningPointOfThePolynomial) {
  CameraModel dut = LookingForward();
  dut.k1 = -2;
  EXPECT_TRUE(dut.Undistort({5000, 5000}).allFinite());
}

/// All of OpenCV's terms.
CameraModel Bent() {
  CameraModel dut = LookingForward();
  dut.k1 = -0.25;
  dut.k2 = 0.08;
  dut.bend = {.k3 = 0.02, .k4 = 0.01, .k5 = 0.02, .k6 = -0.005, .p1 = 0.002, .p2 = -0.0015, .aspect = 1.02};
  return dut;
}

TEST(CameraModel, BendsAsOpenCvDefinesIt) {
  const CameraModel dut = Bent();
  const double x = 0.3, y = -0.2, r2 = x * x + y * y;
  const LensBend& b = dut.bend;
  const double stretch =
      (1 + r2 * (dut.k1 + r2 * (dut.k2 + r2 * b.k3))) / (1 + r2 * (b.k4 + r2 * (b.k5 + r2 * b.k6)));
  const Eigen::Vector2d scale(dut.scale_px, dut.scale_px * b.aspect);
  const Eigen::Vector2d bent(x * stretch + 2 * b.p1 * x * y + b.p2 * (r2 + 2 * x * x),
                             y * stretch + b.p1 * (r2 + 2 * y * y) + 2 * b.p2 * x * y);
  const Eigen::Vector2d seen = dut.Distort(dut.centre_px + scale.cwiseProduct(Eigen::Vector2d(x, y)));
  EXPECT_LT((seen - dut.centre_px - scale.cwiseProduct(bent)).norm(), 1e-9);
}

TEST(CameraModel, UndistortInvertsEveryTermOverTheWholeImage) {
  const CameraModel dut = Bent();
  EXPECT_FALSE(dut.IsRadial());
  for (double u = -20; u <= 790; u += 90)
    for (double v = -20; v <= 600; v += 62) {
      const Eigen::Vector2d px(u, v);
      EXPECT_LT((dut.Undistort(dut.Distort(px)) - px).norm(), 1e-9) << u << " " << v;
    }
}

TEST(CameraModel, ARadialLensIsTheSameInBothForms) {
  CameraModel radial = LookingForward(), bent = radial;
  radial.k1 = bent.k1 = -0.1;
  bent.bend.p1 = 1e-300;  // takes the other way
  EXPECT_FALSE(bent.IsRadial());
  EXPECT_LT((radial.Distort({50, 60}) - bent.Distort({50, 60})).norm(), 1e-9);
  EXPECT_LT((radial.Undistort({50, 60}) - bent.Undistort({50, 60})).norm(), 1e-9);
}

}  // namespace
}  // namespace priamos::head
