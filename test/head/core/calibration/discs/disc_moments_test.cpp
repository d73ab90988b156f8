#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/geometry.hpp"
#include "head/core/calibration/discs/disc_fit.hpp"
#include "test/support/disc_renderer.hpp"
#include "test/support/ellipses.hpp"

namespace priamos::head {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using support::CircleAt;
using support::DiscRenderer;
using support::EllipseAt;

constexpr int kSize = 80;

class DiscMoments : public testing::Test {
 protected:
  /// The truth, drawn; `blur_sigma_px` of the lens.
  GreyImage Image(double blur_sigma_px) {
    DiscRenderer scene(kSize, kSize, 40, 4);
    scene.AddEllipse(truth_, 160);
    return scene.Expose({blur_sigma_px, 0}, rng_);
  }
  /// Start value as a box of bright pixels would give it: upright, a pixel beside the truth.
  Ellipse Guess() const {
    const double half_u = std::sqrt(truth_.shape_px2(0, 0)), half_v = std::sqrt(truth_.shape_px2(1, 1));
    return {truth_.centre_px + Vector2d(0.7, -0.6),
            Vector2d(half_u * half_u, half_v * half_v).asDiagonal().toDenseMatrix()};
  }

  Rng rng_{2};
  Ellipse truth_ = EllipseAt({40.4, 39.3}, 13, 8, 0.7);
};

TEST_F(DiscMoments, CentreAndShapeAreThoseOfTheLightWithoutItsPixels) {
  const auto dut = MeasureMoments(Image(0), Guess());
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->ellipse.centre_px - truth_.centre_px).norm(), 0.01);
  EXPECT_LT((dut->ellipse.shape_px2 - truth_.shape_px2).norm(), 0.01 * truth_.shape_px2.norm());
}

TEST_F(DiscMoments, TheBlurOfTheLensStaysInTheShape) {
  // A Gaussian adds its variance to the light's; a uniform ellipse has a quarter of its shape.
  constexpr double kBlur_px = 0.8;
  const auto dut = MeasureMoments(Image(kBlur_px), Guess());
  ASSERT_TRUE(dut);
  const Matrix2d expected = truth_.shape_px2 + 4 * kBlur_px * kBlur_px * Matrix2d::Identity();
  EXPECT_LT((dut->ellipse.shape_px2 - expected).norm(), 0.01 * expected.norm());
  EXPECT_LT((dut->ellipse.centre_px - truth_.centre_px).norm(), 0.01);
}

TEST_F(DiscMoments, LevelsAreThoseOfThePlateauAndOfTheGround) {
  const auto dut = MeasureMoments(Image(0.7), Guess());
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->background, 40, 0.6);
  EXPECT_NEAR(dut->amplitude, 160, 1);
}

TEST_F(DiscMoments, AnyShapeAndDirectionIsMeasured) {
  for (double turn = 0; turn < kPi; turn += 0.4)
    for (const double minor : {5.0, 8.0, 13.0}) {
      truth_ = EllipseAt({40.1, 40.2}, 13, minor, turn);
      const auto dut = MeasureMoments(Image(0), Guess());
      ASSERT_TRUE(dut) << turn << " " << minor;
      EXPECT_NEAR(dut->ellipse.SemiMajor(), 13, 0.15) << turn;
      EXPECT_NEAR(dut->ellipse.SemiMinor(), minor, 0.15) << turn;
      EXPECT_LT((dut->ellipse.centre_px - truth_.centre_px).norm(), 0.02) << turn;
    }
}

TEST_F(DiscMoments, PixelsOfOtherSpotsDoNotCount) {
  truth_ = CircleAt(40, 40, 9);
  DiscRenderer scene(kSize, kSize, 40, 4);
  scene.AddEllipse(truth_, 160);
  scene.AddEllipse(CircleAt(53, 40, 2.2), 160);
  const GreyImage image = scene.Expose({0, 0}, rng_);
  const auto mistaken = MeasureMoments(image, truth_);
  const std::vector<Ellipse> others{CircleAt(53, 40, 2.9)};
  const auto dut = MeasureMoments(image, truth_, others);
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->ellipse.centre_px - truth_.centre_px).norm(), 0.03);
  EXPECT_TRUE(!mistaken || (mistaken->ellipse.centre_px - truth_.centre_px).norm() > 0.05);
}

TEST_F(DiscMoments, WhereNothingStandsOutThereIsNoDisc) {
  const GreyImage grey{kSize, kSize, std::vector<std::uint8_t>(kSize * kSize, 90)};
  EXPECT_FALSE(MeasureMoments(grey, CircleAt(40, 40, 9)));
  GreyImage dark = Image(0.7);
  for (auto& p : dark.pixels) p = static_cast<std::uint8_t>(255 - p);
  EXPECT_FALSE(MeasureMoments(dark, Guess()));
}

TEST_F(DiscMoments, AWindowThatLeavesTheImageIsNotMeasured) {
  const GreyImage image = Image(0.7);
  EXPECT_FALSE(MeasureMoments(image, CircleAt(10, 40, 9)));
  EXPECT_FALSE(MeasureMoments(image, CircleAt(40, kSize - 11, 9)));
  EXPECT_FALSE(MeasureMoments(GreyImage{}, CircleAt(40, 40, 9)));
  EXPECT_FALSE(MeasureMoments(image, CircleAt(std::numeric_limits<double>::quiet_NaN(), 40, 9)));
}

TEST_F(DiscMoments, HiddenByOthersThereIsNoDisc) {
  const std::vector<Ellipse> others{CircleAt(40, 40, 25)};
  EXPECT_FALSE(MeasureMoments(Image(0.7), Guess(), others));
}

}  // namespace
}  // namespace priamos::head
