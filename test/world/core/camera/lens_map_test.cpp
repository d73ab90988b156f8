#include "world/core/camera/lens_map.hpp"

#include <gtest/gtest.h>

#include "world/core/camera/fine_grid.hpp"

namespace priamos::world {
namespace {

TrueCamera Bent(double focal_px, double p1 = 0) {
  TrueCamera camera;
  camera.focal_px = focal_px;
  camera.k1 = -0.08;
  camera.p1 = p1;
  return camera;
}

Eigen::Vector2d PlaceOf(const LensMap::Pixel& pixel) {
  return {pixel.cell % FineGrid::kWidth + pixel.right + 0.5,
          pixel.cell / FineGrid::kWidth + pixel.down + 0.5};
}

TEST(LensMap, EveryPixelLooksWhereTheLensBendsItsRay) {
  for (const double p1 : {0.0, 1e-3}) {
    const TrueCamera camera = Bent(900, p1);
    const LensMap dut(camera, 0.25);
    for (const int v : {0, 2, 287, 575}) {
      for (const int u : {0, 101, 383, 767}) {
        const Eigen::Vector2d expected = FineGrid::FromImage(camera.Undistort(Eigen::Vector2d(u, v)));
        EXPECT_LT((PlaceOf(dut.pixels().at(v * kImageWidth_px + u)) - expected).norm(), 2e-3)
            << u << " " << v;
      }
    }
  }
}

TEST(LensMap, StaysOnTheGridWhateverTheLensDoes) {
  TrueCamera camera = Bent(400);
  camera.k1 = 0.5;
  camera.centre_px = {-300, 900};
  const LensMap dut(camera, 0.25);
  for (const LensMap::Pixel& pixel : dut.pixels()) {
    ASSERT_GE(pixel.cell, 0);
    ASSERT_LT(pixel.cell + FineGrid::kWidth + 1, FineGrid::kWidth * FineGrid::kHeight);
    ASSERT_GT(pixel.light, 0);
    ASSERT_LE(pixel.light, 1);
  }
}

TEST(LensMap, IsOfALensWhereverItsCameraStands) {
  TrueCamera camera = Bent(900);
  const LensMap dut(camera, 0.25);
  camera.base_from_camera.translation() = Eigen::Vector3d(1, 2, 3);
  EXPECT_TRUE(dut.IsOf(camera, 0.25));
  EXPECT_FALSE(dut.IsOf(camera, 0.2));
  camera.k3 = 1e-6;
  EXPECT_FALSE(dut.IsOf(camera, 0.25));
}

TEST(LensMaps, KeepTheNewestSix) {
  LensMaps dut;
  for (int i = 0; i < 6; ++i) dut.Of(Bent(900 + i), 0.25);
  const auto* first = dut.Of(Bent(900), 0.25).pixels().data();
  dut.Of(Bent(950), 0.25);
  EXPECT_EQ(dut.Of(Bent(900), 0.25).pixels().data(), first) << "used lately";
  EXPECT_TRUE(dut.Of(Bent(901), 0.25).IsOf(Bent(901), 0.25)) << "made anew";
}

}  // namespace
}  // namespace priamos::world
