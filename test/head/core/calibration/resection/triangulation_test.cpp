#include "head/core/calibration/resection/triangulation.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/geometry.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using support::Between;

CameraModel CameraAt(double azimuth_rad, double distance_m = 1.5, double k1 = 0) {
  support::CameraView view;
  view.azimuth_rad = azimuth_rad;
  view.distance_m = distance_m;
  view.k1 = k1;
  return support::MakeCamera(view);
}

Ray RayTo(const CameraModel& camera, const Vector3d& point_m, const Vector2d& off_px = {0, 0}) {
  return {&camera, camera.Distort(camera.Project(point_m)) + off_px};
}

/// The sum of squares in the image, which triangulation is to make least.
double SquaresAt(const std::vector<Ray>& rays, const Vector3d& at) {
  double sum = 0;
  for (const Ray& ray : rays)
    sum += (ray.camera->Project(at) - ray.camera->Undistort(ray.image_px)).squaredNorm();
  return sum;
}

RC_GTEST_PROP(Triangulation, FindsThePointThatTwoDistortedImagesShow, ()) {
  const CameraModel left = CameraAt(Between(-0.5, -0.1), Between(1, 3), Between(-0.1, 0.1)),
                    right = CameraAt(Between(0.1, 0.5), Between(1, 3), Between(-0.1, 0.1));
  const Vector3d truth(Between(-0.2, 0.2), Between(-0.2, 0.2), Between(-0.2, 0.2));
  const auto dut = Triangulate(std::vector{RayTo(left, truth), RayTo(right, truth)});
  RC_ASSERT(dut.has_value());
  RC_ASSERT((*dut - truth).norm() < 1e-6);
}

TEST(Triangulation, MakesTheImageErrorLeast) {
  const CameraModel near = CameraAt(-0.3, 1), far = CameraAt(0.2, 3), third = CameraAt(0.6, 2);
  const Vector3d truth(0.1, 0.05, -0.1);
  const std::vector<Ray> rays{RayTo(near, truth, {1, -2}), RayTo(far, truth, {-1.5, 1}),
                              RayTo(third, truth, {0.5, 2})};
  const auto dut = Triangulate(rays);
  ASSERT_TRUE(dut);
  const double least = SquaresAt(rays, *dut);
  for (int axis = 0; axis < 3; ++axis)
    for (const double step : {-2e-4, 2e-4})
      EXPECT_GT(SquaresAt(rays, *dut + step * Vector3d::Unit(axis)), least) << axis << " " << step;
}

TEST(Triangulation, AThirdCameraAveragesTheNoise) {
  Rng rng(5);
  const CameraModel left = CameraAt(-0.2), right = CameraAt(0.2), third = CameraAt(0);
  double two = 0, three = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d truth(0.05, rng.Uniform(-0.2, 0.2), rng.Uniform(-0.2, 0.2));
    std::vector<Ray> rays;
    for (const CameraModel* camera : {&left, &right, &third})
      rays.push_back(RayTo(*camera, truth, {rng.Normal(0.5), rng.Normal(0.5)}));
    two += (*Triangulate(std::span(rays).first(2)) - truth).squaredNorm();
    three += (*Triangulate(rays) - truth).squaredNorm();
  }
  EXPECT_LT(three, two);
}

TEST(Triangulation, FewerThanTwoRaysShowNoPoint) {
  const CameraModel camera = CameraAt(0);
  EXPECT_FALSE(Triangulate({}));
  EXPECT_FALSE(Triangulate(std::vector{RayTo(camera, {0, 0, 0})}));
}

TEST(Triangulation, ParallelRaysMeetNowhere) {
  const CameraModel camera = CameraAt(0);
  const Ray ray = RayTo(camera, {0, 0.1, 0});
  EXPECT_FALSE(Triangulate(std::vector{ray, ray}));
  // A second camera a metre beside the first that looks the same way, and the same pixel.
  CameraModel beside = camera;
  beside.image_from_base.col(3) -= camera.image_from_base.leftCols<3>() * Vector3d(0, 1, 0);
  EXPECT_FALSE(Triangulate(std::vector{ray, Ray{&beside, ray.image_px}}));
}

TEST(Triangulation, APointBehindACameraIsNone) {
  // The lines of sight meet behind both cameras: the pixels have been exchanged.
  const CameraModel left = CameraAt(-0.3), right = CameraAt(0.3);
  const Vector3d truth(0.12, 0, 0);
  const Vector2d shift(600, 0);
  EXPECT_TRUE(Triangulate(std::vector{RayTo(left, truth), RayTo(right, truth)}));
  EXPECT_FALSE(Triangulate(std::vector{RayTo(left, truth, -shift), RayTo(right, truth, shift)}));
}

}  // namespace
}  // namespace priamos::head
