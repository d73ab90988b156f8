#include "head/core/calibration/discs/disc_projection.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"
#include "test/support/calibration_scene.hpp"

namespace priamos::head {
namespace {

using support::CameraView;
using support::MakeCamera;

CameraModel FrontView(double focal_px, double distance_m) {
  CameraView view;
  view.focal_px = focal_px;
  view.distance_m = distance_m;
  view.target_m = {0, 0, 0};
  return MakeCamera(view);
}

TEST(DiscProjection, ADiscSeenFromTheFrontIsACircle) {
  const CameraModel camera = FrontView(1000, 2);
  const auto ellipse = ProjectDisc(camera.image_from_base, {{0, 0, 0}, {1, 0, 0}, 0.02});
  ASSERT_TRUE(ellipse);
  EXPECT_NEAR(ellipse->SemiMajor(), 10, 1e-9);
  EXPECT_NEAR(ellipse->SemiMinor(), 10, 1e-9);
  EXPECT_NEAR(ellipse->Area(), kPi * 100, 1e-6);
  EXPECT_LT((ellipse->centre_px - camera.centre_px).norm(), 1e-9);
}

TEST(DiscProjection, TheRimLiesOnTheEllipse) {
  Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const CameraModel camera = MakeCamera(support::RandomView(rng));
    const ReferenceDisc disc{{0.1, 0.2, -0.1}, Eigen::Vector3d(1, 0.3, -0.2).normalized(), 0.03};
    const auto ellipse = ProjectDisc(camera.image_from_base, disc);
    ASSERT_TRUE(ellipse);
    const Eigen::Vector3d e1 = disc.normal.unitOrthogonal(), e2 = disc.normal.cross(e1);
    for (double t = 0; t < 6; t += 0.5) {
      const Eigen::Vector2d d =
          camera.Project(disc.centre_m + disc.radius_m * (std::cos(t) * e1 + std::sin(t) * e2)) -
          ellipse->centre_px;
      EXPECT_NEAR(d.dot(ellipse->shape_px2.inverse() * d), 1, 1e-7);
    }
  }
}

TEST(DiscProjection, TheEllipsesCentreIsNotTheImageOfTheDiscsCentre) {
  CameraView view;
  view.focal_px = 1200;
  view.distance_m = 1.5;
  view.azimuth_rad = Radians(45);
  view.target_m = {0, 0, 0};
  EXPECT_NEAR(CentroidBias(MakeCamera(view), {{0, 0, 0}, {1, 0, 0}, 0.020}).norm(), 0.107, 0.002);
  view.distance_m = 1;
  EXPECT_NEAR(CentroidBias(MakeCamera(view), {{0, 0, 0}, {1, 0, 0}, 0.030}).norm(), 0.54, 0.01);
}

/// The centroid of the distorted ellipse from a fine grid of distorted pixels.
Eigen::Vector2d CentroidByCounting(const CameraModel& camera, const Ellipse& straight) {
  const Eigen::Vector2d middle = camera.Distort(straight.centre_px);
  const Eigen::Matrix2d inverse = straight.shape_px2.inverse();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double n = 0;
  for (double du = -50; du <= 50; du += 0.125) {
    for (double dv = -50; dv <= 50; dv += 0.125) {
      const Eigen::Vector2d px = middle + Eigen::Vector2d(du, dv);
      const Eigen::Vector2d d = camera.Undistort(px) - straight.centre_px;
      if (d.dot(inverse * d) > 1) continue;
      sum += px;
      ++n;
    }
  }
  return sum / n;
}

TEST(DiscProjection, LensDistortionMovesTheCentroidToo) {
  CameraView view;
  view.focal_px = 800;
  view.distance_m = 1;
  view.target_m = {0, 0, 0};
  view.target_offset_px = {300, 200};
  const ReferenceDisc disc{{0, 0, 0}, {1, 0, 0}, 0.04};
  view.k1 = -0.1;
  const CameraModel camera = MakeCamera(view);
  const Ellipse straight = *ProjectDisc(camera.image_from_base, disc);
  const Eigen::Vector2d expected = CentroidByCounting(camera, straight);
  EXPECT_LT((*ProjectDiscCentroid(camera, disc) - expected).norm(), 0.002);
  EXPECT_GT((camera.Distort(straight.centre_px) - expected).norm(), 0.1);
}

TEST(DiscProjection, WhatIsNotBeforeTheCameraHasNoImage) {
  const CameraModel camera = FrontView(1000, 2);
  EXPECT_FALSE(ProjectDisc(camera.image_from_base, {{3, 0, 0}, {1, 0, 0}, 0.02}));
  EXPECT_FALSE(ProjectDisc(camera.image_from_base, {{1.999, 0, 0}, {0, 1, 0}, 0.02}));
  EXPECT_FALSE(ProjectDisc(camera.image_from_base, {{0, 0, 0}, {0, 1, 0}, 0.02}));  // edge-on
}

}  // namespace
}  // namespace priamos::head
