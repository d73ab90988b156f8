#include "head/core/calibration/discs/disc_detection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"
#include "test/support/ellipses.hpp"

namespace priamos::head {
namespace {

using support::CircleAt;
using support::DiscRenderer;

/// RMS of the distance between true and measured centre over `n` exposures; all must be found.
double CentreRms(int n, double radius, double tilt_rad, const support::Exposure& exposure) {
  Rng rng(7);
  double squares = 0;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d centre(48 + rng.Uniform(-0.5, 0.5), 48 + rng.Uniform(-0.5, 0.5));
    const Ellipse ellipse =
        support::EllipseAt(centre, radius, radius * std::cos(tilt_rad), rng.Uniform(0, kPi));
    DiscRenderer scene(96, 96, 20, 3);
    scene.AddEllipse(ellipse, 200);
    const auto found = DetectDiscs(scene.Expose(exposure, rng));
    EXPECT_EQ(found.size(), 1u);
    if (found.size() == 1) squares += (found[0].ellipse.centre_px - centre).squaredNorm();
  }
  return std::sqrt(squares / n);
}

TEST(DiscDetection, FrontViewIsWithinSevenThousandthsOfAPixel) {
  EXPECT_LE(CentreRms(200, 8, 0, {0.7, 2}), 0.0075);
}

TEST(DiscDetection, TiltedDiscsAreAsPrecise) {
  EXPECT_LE(CentreRms(100, 16, Radians(45), {0.7, 2}), 0.0075);
}

TEST(DiscDetection, SmallFarDiscsAreFoundToo) {
  EXPECT_LE(CentreRms(100, 4, Radians(35), {0.7, 2}), 0.02);
}

TEST(DiscDetection, DefocusAndSharpRimsAreBothUnderstood) {
  EXPECT_LE(CentreRms(100, 8, 0, {1.5, 2}), 0.02);
  EXPECT_LE(CentreRms(100, 8, 0, {0.0, 2}), 0.02);
}

TEST(DiscDetection, ShadingDoesNotShiftTheCentre) {
  Rng rng(1);
  DiscRenderer dark(96, 96, 40, 3);
  dark.AddSlope({0.3, -0.2});
  dark.AddEllipse(CircleAt(48.2, 47.9, 9), 150);
  const auto found = DetectDiscs(dark.Expose({0.7, 0}, rng));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT((found[0].ellipse.centre_px - Eigen::Vector2d(48.2, 47.9)).norm(), 0.006);
}

TEST(DiscDetection, SaturationDoesNotShiftTheCentre) {
  Rng rng(1);
  DiscRenderer scene(96, 96, 40, 3);
  scene.AddEllipse(CircleAt(48.2, 47.9, 9), 400);
  const auto found = DetectDiscs(scene.Expose({0.7, 2}, rng));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT((found[0].ellipse.centre_px - Eigen::Vector2d(48.2, 47.9)).norm(), 0.02);
}

TEST(DiscDetection, ReportsShapeLevelsAndItsOwnPrecision) {
  Rng rng(5);
  DiscRenderer scene(96, 96, 30, 3);
  scene.AddEllipse(CircleAt(48, 48, 12), 160);
  const auto found = DetectDiscs(scene.Expose({0.8, 2}, rng));
  ASSERT_EQ(found.size(), 1u);
  const DetectedDisc& dut = found[0];
  EXPECT_NEAR(dut.ellipse.SemiMajor(), 12, 0.1);
  EXPECT_NEAR(dut.amplitude, 160, 1);
  EXPECT_NEAR(dut.background, 30, 1);
  EXPECT_NEAR(dut.blur_sigma_px, 0.8, 0.05);
  EXPECT_GT(dut.sigma_px, 0.001);
  EXPECT_LT(dut.sigma_px, 0.01);
}

TEST(DiscDetection, GainAndOffsetOfTheCameraDoNotMatter) {
  Rng rng(2);
  for (const double amplitude : {40.0, 90.0, 200.0}) {
    DiscRenderer scene(96, 96, 50, 2);
    scene.AddEllipse(CircleAt(40, 50, 8), amplitude);
    EXPECT_EQ(DetectDiscs(scene.Expose({0.7, 2}, rng)).size(), 1u) << amplitude;
  }
}

TEST(DiscDetection, RejectsWhatIsNotAnEllipse) {
  Rng rng(2);
  DiscRenderer scene(400, 200, 30, 2);
  scene.AddRectangle(20, 20, 60, 60, 150);        // a square
  scene.AddRectangle(100, 20, 104, 180, 150);     // a stripe
  scene.AddRectangle(150, 0, 399, 60, 150);       // a wall at the border
  scene.AddEllipse(CircleAt(2, 100, 10), 150);    // cut by the border
  scene.AddEllipse(CircleAt(200, 120, 10), 150);  // two that touch
  scene.AddEllipse(CircleAt(217, 122, 10), 150);
  EXPECT_TRUE(DetectDiscs(scene.Expose({0.7, 2}, rng)).empty());
}

TEST(DiscDetection, RejectsAHalfHiddenDisc) {
  Rng rng(2);
  for (double covered_px = 2; covered_px < 20; covered_px += 1.5) {
    DiscRenderer scene(96, 96, 30, 3);
    scene.AddEllipse(CircleAt(48, 48, 12), 150);
    scene.Cover(0, 0, 36 + covered_px, 95, 30);
    for (const DetectedDisc& disc : DetectDiscs(scene.Expose({0.7, 2}, rng))) {
      ADD_FAILURE() << "covered " << covered_px << " px: taken for a disc, misfit " << disc.residual;
    }
  }
}

TEST(DiscDetection, NoiseAndEmptyImagesHoldNoDiscs) {
  Rng rng(2);
  EXPECT_TRUE(DetectDiscs(DiscRenderer(200, 200, 60, 1).Expose({0, 6}, rng)).empty());
  EXPECT_TRUE(DetectDiscs(GreyImage{}).empty());
}

TEST(DiscDetection, FindsEveryDiscOfTheReferenceObject) {
  Rng rng(11);
  const ReferenceObject object = support::ShippedReferenceObject();
  const CameraModel camera = support::MakeCamera({});
  DiscRenderer scene(768, 576, 25, 1);
  for (const ReferenceDisc& disc : object.discs) scene.AddDisc(camera, disc, 180);
  const auto found = DetectDiscs(scene.Expose({}, rng));
  ASSERT_EQ(found.size(), object.discs.size());
  for (const ReferenceDisc& disc : object.discs) {
    double nearest = 1e9;
    for (const DetectedDisc& f : found) {
      nearest = std::min(nearest, (f.ellipse.centre_px - *ProjectDiscCentroid(camera, disc)).norm());
    }
    EXPECT_LT(nearest, 0.02);
  }
}

}  // namespace
}  // namespace priamos::head
