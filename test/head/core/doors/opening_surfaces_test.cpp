#include "head/core/doors/opening_surfaces.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

const OpeningShape kOpening{{2.2, 0, 0}, 0.9, 2.0};

CameraModel Looking(double y_m) {
  CameraModel camera;
  Eigen::Matrix3d k, turn;
  k << 900, 0, 383.5, 0, 900, 287.5, 0, 0, 1;
  turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;  // right, down, forward
  camera.image_from_base << k * turn, -k * turn * Vector3d(0.25, y_m, 1.2);
  camera.scale_px = 900;
  return camera;
}

/// Bumps of 3 to 8 cm.
double Texture(double y, double z) {
  return 120 + 12 * (std::sin(61 * y + 3 * std::sin(23 * z)) + std::sin(97 * z + 2 * std::sin(31 * y)) +
                     std::sin(130 * y + 71 * z));
}

/// The picture of a wall of texture whose distance behind the front is a function of y (base frame, walls
/// stand at x = 2.2 + depth(y)), found by going along each sight.
GreyImage Picture(const CameraModel& camera, const std::function<double(double)>& depth_m, double gain) {
  const Vector3d eye = OpticalCentre(camera);
  const Eigen::Matrix3d ray_from_image = camera.image_from_base.leftCols<3>().inverse();
  GreyImage image{768, 576, {}};
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      Vector3d ray = ray_from_image * Vector3d(u, v, 1);
      ray /= ray.x();
      double x = 2.2;
      for (int i = 0; i < 30; ++i) x = 2.2 + depth_m(eye.y() + ray.y() * (x - eye.x()));
      const Vector3d at = eye + ray * (x - eye.x());
      image.pixels.push_back(
          static_cast<std::uint8_t>(std::clamp(gain * Texture(at.y(), at.z()), 0.0, 255.0)));
    }
  }
  return image;
}

std::vector<SurfacePoint> Seen(const std::function<double(double)>& depth_m, double right_gain = 1) {
  const CameraModel left = Looking(0.15), right = Looking(-0.15);
  const GreyImage first = Picture(left, depth_m, 1), second = Picture(right, depth_m, right_gain);
  return SurfacesIn(kOpening, {{&first, &second}, {&left, &right}});
}

TEST(OpeningSurfaces, AClosedLeafIsWhereItIs) {
  const auto points = Seen([](double) { return 0.08; });
  ASSERT_GT(points.size(), 10u);
  for (const SurfacePoint& p : points) {
    EXPECT_NEAR(p.at.x(), 0.08, 0.01);
    EXPECT_LT(std::abs(p.at.y()), 0.45);
  }
}

TEST(OpeningSurfaces, ALeafAtAnAngleIsALine) {
  const auto points = Seen([](double y) { return 0.05 + 0.3 * (0.45 - y); });
  ASSERT_GT(points.size(), 10u);
  for (const SurfacePoint& p : points) EXPECT_NEAR(p.at.x(), 0.05 + 0.3 * (0.45 - p.at.y()), 0.03);
}

TEST(OpeningSurfaces, ARoomIsFarBehind) {
  const auto points = Seen([](double) { return 1.8; });
  ASSERT_GT(points.size(), 10u);
  for (const SurfacePoint& p : points) EXPECT_NEAR(p.at.x(), 1.8, 0.1);
}

TEST(OpeningSurfaces, CamerasMayDifferInBrightness) {
  const auto points = Seen([](double) { return 0.08; }, 0.6);
  ASSERT_GT(points.size(), 10u);
  for (const SurfacePoint& p : points) EXPECT_NEAR(p.at.x(), 0.08, 0.01);
}

TEST(OpeningSurfaces, ABlankLeafTellsNothing) {
  const CameraModel left = Looking(0.15), right = Looking(-0.15);
  const GreyImage grey{768, 576, std::vector<std::uint8_t>(768 * 576, 120)};
  EXPECT_TRUE(SurfacesIn(kOpening, {{&grey, &grey}, {&left, &right}}).empty());
}

TEST(OpeningSurfaces, ADoorAtTheCamerasTellsNothing) {
  const CameraModel left = Looking(0.15), right = Looking(-0.15);
  const GreyImage grey{768, 576, std::vector<std::uint8_t>(768 * 576, 120)};
  EXPECT_TRUE(SurfacesIn({{0.3, 0, 0}, 0.9, 2.0}, {{&grey, &grey}, {&left, &right}}).empty());
}

}  // namespace
}  // namespace priamos::head
