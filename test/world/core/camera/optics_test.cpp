#include "world/core/camera/optics.hpp"

#include <gtest/gtest.h>

#include "common/config.hpp"
#include "common/random.hpp"
#include "test/support/image_from_base.hpp"

namespace priamos::world {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

TEST(CameraAt, NominalCamerasStandWhereTheConventionsSay) {
  const TrueCamera left = CameraAt(HeadBuild{}, kLeftCamera, {});
  const TrueCamera right = CameraAt(HeadBuild{}, kRightCamera, {});
  const TrueCamera third = CameraAt(HeadBuild{}, kThirdCamera, {});
  const Vector3d baseline = left.base_from_camera.translation() - right.base_from_camera.translation();
  EXPECT_TRUE(baseline.isApprox(Vector3d(0, 0.30, 0), 1e-12));
  EXPECT_NEAR(left.base_from_camera.translation().z(), 1.20, 1e-12);
  EXPECT_NEAR(third.base_from_camera.translation().z(), 1.32, 1e-12);
  EXPECT_NEAR(third.base_from_camera.translation().y(), 0, 1e-12);
  EXPECT_TRUE((left.base_from_camera.linear() * Vector3d::UnitZ()).isApprox(Vector3d::UnitX())) << "forward";
  EXPECT_TRUE((left.base_from_camera.linear() * Vector3d::UnitX()).isApprox(-Vector3d::UnitY())) << "right";
  EXPECT_NEAR(left.focal_px, 1000, 15);
}

TEST(CameraAt, WhatIsLeftAndAboveAppearsLeftAndAbove) {
  const TrueCamera dut = CameraAt(HeadBuild{}, kThirdCamera, {});
  const Vector2d ahead = dut.Project({3, 0, 1.32});
  EXPECT_TRUE(ahead.isApprox(dut.centre_px, 1e-9));
  EXPECT_LT(dut.Project({3, 0.5, 1.32}).x(), ahead.x());
  EXPECT_LT(dut.Project({3, 0, 1.6}).y(), ahead.y());
}

TEST(CameraAt, PanTurnsLeftTiltLooksDownVergenceTurnsOneCamera) {
  const Vector3d point(3, 0, 1.2);
  HeadAxes axes;
  const Vector2d before = CameraAt(HeadBuild{}, kLeftCamera, axes).Project(point);
  axes.pan_rad = 0.05;
  EXPECT_NEAR(CameraAt(HeadBuild{}, kLeftCamera, axes).Project(point).x() - before.x(), 50, 8);
  axes = {};
  axes.tilt_rad = 0.05;
  EXPECT_NEAR(CameraAt(HeadBuild{}, kLeftCamera, axes).Project(point).y() - before.y(), -50, 8);
  axes = {};
  axes.vergence_rad[0] = -0.05;  // to the right
  EXPECT_NEAR(CameraAt(HeadBuild{}, kLeftCamera, axes).Project(point).x() - before.x(), -50, 8);
  const Vector2d right = CameraAt(HeadBuild{}, kRightCamera, {}).Project(point);
  EXPECT_EQ(CameraAt(HeadBuild{}, kRightCamera, axes).Project(point), right);
}

TEST(CameraAt, PanTurnsAboutThePanAxis) {
  HeadAxes axes;
  axes.pan_rad = kPi / 2;
  const TrueCamera dut = CameraAt(HeadBuild{}, kLeftCamera, axes);
  EXPECT_NEAR(dut.base_from_camera.translation().x(), 0.25 - 0.15, 1e-12);
  EXPECT_TRUE((dut.base_from_camera.linear() * Vector3d::UnitZ()).isApprox(Vector3d::UnitY()));
}

TEST(CameraAt, ZoomSpansTheFocalLengthsAndFocusTheDistances) {
  HeadAxes axes;
  axes.zoom_step = {0, 2000};
  axes.focus_step = {2000, 2000};
  EXPECT_NEAR(CameraAt(HeadBuild{}, kLeftCamera, axes).focal_px, 800, 1e-9);
  EXPECT_NEAR(CameraAt(HeadBuild{}, kRightCamera, axes).focal_px, 1600, 1e-9);
  EXPECT_EQ(CameraAt(HeadBuild{}, kLeftCamera, axes).focus_dioptre, 0);
  axes.focus_step = {0, 0};
  EXPECT_NEAR(CameraAt(HeadBuild{}, kLeftCamera, axes).focus_dioptre, 1 / 0.6, 1e-9);
  EXPECT_GT(CameraAt(HeadBuild{}, kLeftCamera, axes).focal_px, 800) << "focus breathes";
}

TEST(CameraAt, TheThirdCameraHasNoMotorsOfItsOwn) {
  HeadAxes axes;
  axes.vergence_rad = {0.1, -0.1};
  axes.zoom_step = {0, 2000};
  const TrueCamera moved = CameraAt(HeadBuild{}, kThirdCamera, axes),
                   still = CameraAt(HeadBuild{}, kThirdCamera, {});
  EXPECT_EQ(moved.focal_px, still.focal_px);
  EXPECT_TRUE(moved.base_from_camera.isApprox(still.base_from_camera));
}

TEST(TrueCamera, UndistortInvertsDistortOverTheImage) {
  Rng rng(7);
  for (int i = 0; i < 2000; ++i) {
    TrueCamera dut;
    dut.k1 = rng.Uniform(-0.15, 0.1);
    dut.k2 = rng.Uniform(-0.03, 0.05);
    dut.focal_px = rng.Uniform(790, 1700);
    const Vector2d seen(rng.Uniform(-1, 768), rng.Uniform(-1, 576));
    EXPECT_LT((dut.Distort(dut.Undistort(seen)) - seen).norm(), 1e-9);
  }
}

TEST(TrueCamera, TheMatrixIsTheProjectionWithoutDistortion) {
  TrueCamera dut = CameraAt(HeadBuild::Specimen(3), kRightCamera, {});
  dut.k1 = dut.k2 = 0;
  const Vector3d point(2.7, -0.4, 1.9);
  const Vector3d h = ImageFromBase(dut) * point.homogeneous();
  EXPECT_LT((h.hnormalized() - dut.Project(point)).norm(), 1e-9);
  EXPECT_NEAR(ImageFromBase(dut).row(2).head<3>().norm(), 1, 1e-12);
}

TEST(HeadBuild, SpecimensDifferAndCanBeHadAgain) {
  const TrueCamera a = CameraAt(HeadBuild::Specimen(1), kLeftCamera, {});
  const TrueCamera b = CameraAt(HeadBuild::Specimen(2), kLeftCamera, {});
  const TrueCamera again = CameraAt(HeadBuild::Specimen(1), kLeftCamera, {});
  const Vector3d point(3, 0.2, 1.0);
  EXPECT_EQ(a.Project(point), again.Project(point));
  EXPECT_GT((a.Project(point) - b.Project(point)).norm(), 1) << "worth calibrating";
  EXPECT_LT((a.Project(point) - b.Project(point)).norm(), 100) << "but the same kind of head";
}

TEST(HeadBuild, IsConfigured) {
  const auto dut = ParseConfig<HeadBuild>("head.toml", "z_m = 1.3\n[left]\nk1_wide = -0.1\n");
  EXPECT_EQ(dut.z_m, 1.3);
  EXPECT_EQ(dut.cameras[kLeftCamera].k1_wide, -0.1);
  EXPECT_EQ(dut.cameras[kRightCamera].y_m, -0.15);
  EXPECT_THROW(ParseConfig<HeadBuild>("head.toml", "[left]\nk1_wide = -2\n"), ConfigError);
  EXPECT_THROW(ParseConfig<HeadBuild>("head.toml", "[left]\nkk = 0\n"), ConfigError);
}

TEST(TrueCamera, UndistortInvertsTheOtherFormsOfDistortionToo) {
  Rng rng(8);
  for (int i = 0; i < 2000; ++i) {
    TrueCamera dut;
    dut.k1 = rng.Uniform(-0.15, 0.1);
    dut.k3 = rng.Uniform(-0.05, 0.1);
    dut.p1 = rng.Uniform(-0.005, 0.005);
    dut.p2 = rng.Uniform(-0.005, 0.005);
    dut.focal_px = rng.Uniform(790, 1700);
    const Vector2d seen(rng.Uniform(-1, 768), rng.Uniform(-1, 576));
    EXPECT_LT((dut.Distort(dut.Undistort(seen)) - seen).norm(), 1e-6);
  }
}

TEST(TrueCamera, TangentialDistortionMovesAPointAcrossItsRadius) {
  TrueCamera dut;
  dut.p1 = 0.002;
  const Vector2d right = dut.centre_px + Vector2d(300, 0);
  // p1 (r^2 + 2 y^2) f with r = 0.3
  EXPECT_NEAR((dut.Distort(right) - right).y(), 0.002 * 0.09 * 1000, 1e-9);
  EXPECT_NEAR((dut.Distort(right) - right).x(), 0, 1e-9);
}

TEST(CameraAt, AMastThatNodsTurnsTheCamerasAboutItsFoot) {
  HeadAxes axes;
  axes.lean.pitch_rad = 0.01;
  const TrueCamera still = CameraAt(HeadBuild{}, kLeftCamera, {}),
                   dut = CameraAt(HeadBuild{}, kLeftCamera, axes);
  const Vector3d moved = dut.base_from_camera.translation() - still.base_from_camera.translation();
  EXPECT_NEAR(moved.x(), 0.01 * (still.base_from_camera.translation().z() - 0.6), 1e-4);
  EXPECT_NEAR(dut.base_from_camera.linear().col(2).z(), -0.01, 1e-4) << "looks down";
}

}  // namespace
}  // namespace priamos::world
