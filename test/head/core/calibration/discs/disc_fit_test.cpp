#include "head/core/calibration/discs/disc_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "head/core/calibration/discs/disc_window.hpp"
#include "test/support/disc_renderer.hpp"
#include "test/support/ellipses.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::CircleAt;
using support::DiscRenderer;
using support::EllipseAt;

constexpr int kSize = 80;
constexpr double kAmplitude = 150, kGround = 35;

GreyImage Render(const Ellipse& e, Rng& rng, const support::Exposure& exposure = {0.7, 0}) {
  DiscRenderer scene(kSize, kSize, kGround, 3);
  scene.AddEllipse(e, kAmplitude);
  return scene.Expose(exposure, rng);
}

/// Where blur leaves half of the light at the end of a semi-axis: a curved rim loses more than it gains.
double HalfLevel(double semi_axis_px, double other_px, double blur_sigma_px) {
  const double variance = blur_sigma_px * blur_sigma_px + kPixelVariance;
  return semi_axis_px - variance / (2 * other_px * other_px / semi_axis_px);
}

/// What a detector might begin with: nearly right.
DetectedDisc Start(const Ellipse& truth, const Vector2d& off = {0.4, -0.3}) {
  DetectedDisc start;
  start.ellipse = {truth.centre_px + off, 1.1 * truth.shape_px2};
  start.amplitude = 0.9 * kAmplitude;
  start.background = kGround + 3;
  start.blur_sigma_px = 0.7;
  return start;
}

class DiscFit : public testing::Test {
 protected:
  Rng rng{9};
  const Ellipse truth = EllipseAt({40.3, 39.6}, 12, 8, 0.5);
};

TEST_F(DiscFit, FindsCentreShapeLevelsAndBlur) {
  const auto dut = FitDisc(Render(truth, rng, {0.9, 0}), Start(truth));
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->ellipse.centre_px - truth.centre_px).norm(), 0.005);
  EXPECT_NEAR(dut->ellipse.SemiMajor(), HalfLevel(12, 8, 0.9), 0.02);
  EXPECT_NEAR(dut->ellipse.SemiMinor(), HalfLevel(8, 12, 0.9), 0.02);
  EXPECT_LT((dut->ellipse.shape_px2 - truth.shape_px2).norm(), 0.02 * truth.shape_px2.norm());
  EXPECT_NEAR(dut->amplitude, kAmplitude, 1);
  EXPECT_NEAR(dut->background, kGround, 0.5);
  EXPECT_NEAR(dut->blur_sigma_px, 0.9, 0.05);
  EXPECT_LT(dut->residual, 1.5);
}

TEST_F(DiscFit, DoesNotDependOnWhereItBegins) {
  const GreyImage image = Render(truth, rng);
  const auto first = FitDisc(image, Start(truth, {0, 0}));
  ASSERT_TRUE(first);
  for (const Vector2d& off : {Vector2d(0.8, 0), Vector2d(-0.8, 0), Vector2d(0, 0.8), Vector2d(0.5, -0.5)}) {
    const auto dut = FitDisc(image, Start(truth, off));
    ASSERT_TRUE(dut) << off.transpose();
    EXPECT_LT((dut->ellipse.centre_px - first->ellipse.centre_px).norm(), 0.003) << off.transpose();
  }
}

TEST_F(DiscFit, MovesWithTheImageByWholePixels) {
  const auto here = FitDisc(Render(truth, rng), Start(truth));
  Ellipse moved = truth;
  moved.centre_px += Vector2d(5, -7);
  const auto there = FitDisc(Render(moved, rng), Start(moved));
  ASSERT_TRUE(here && there);
  EXPECT_LT((there->ellipse.centre_px - here->ellipse.centre_px - Vector2d(5, -7)).norm(), 1e-4);
  EXPECT_NEAR(there->sigma_px, here->sigma_px, 0.02 * here->sigma_px);
}

/// Noisy pictures of a disc of 8 px, each a little elsewhere; small ones, because they are many.
class DiscFitPrecision : public testing::Test {
 protected:
  static constexpr int kTimes = 100;
  GreyImage Next() {
    truth_ = CircleAt(20 + rng_.Uniform(-0.5, 0.5), 20 + rng_.Uniform(-0.5, 0.5), 8);
    DiscRenderer scene(40, 40, kGround, 2);
    scene.AddEllipse(truth_, kAmplitude);
    return scene.Expose({0.7, 4}, rng_);
  }
  double SquareError(const DetectedDisc& dut) const {
    return (dut.ellipse.centre_px - truth_.centre_px).squaredNorm();
  }

  Rng rng_{9};
  Ellipse truth_;
};

TEST_F(DiscFitPrecision, TellsHowFarItsCentresScatter) {
  double squares = 0, told = 0;
  for (int i = 0; i < kTimes; ++i) {
    const GreyImage image = Next();
    const auto dut = FitDisc(image, Start(truth_));
    ASSERT_TRUE(dut);
    squares += SquareError(*dut) / 2 / kTimes;  // of one coordinate
    told += dut->sigma_px / kTimes;
  }
  EXPECT_NEAR(std::sqrt(squares) / told, 1, 0.25);
}

TEST_F(DiscFitPrecision, TheResidualIsTheNoiseAlsoOfFewPixels) {
  double squares = 0;
  for (int i = 0; i < kTimes; ++i) {
    const Ellipse small = CircleAt(20 + rng_.Uniform(-0.5, 0.5), 20 + rng_.Uniform(-0.5, 0.5), 3);
    DiscRenderer scene(40, 40, kGround, 2);
    scene.AddEllipse(small, kAmplitude);
    const auto dut = FitDisc(scene.Expose({0.7, 4}, rng_), Start(small, {0.2, 0.1}));
    ASSERT_TRUE(dut);
    squares += dut->residual * dut->residual / kTimes;
  }
  EXPECT_NEAR(squares / (4 * 4), 1, 0.08);  // twelve unknowns take a tenth of the pixels
}

TEST_F(DiscFitPrecision, IsMorePreciseThanTheCentroid) {
  double fitted = 0, centroid = 0;
  for (int i = 0; i < kTimes; ++i) {
    const GreyImage image = Next();
    const auto moments = MeasureMoments(image, truth_);
    ASSERT_TRUE(moments);
    const auto dut = FitDisc(image, *moments);
    ASSERT_TRUE(dut);
    fitted += SquareError(*dut);
    centroid += SquareError(*moments);
  }
  EXPECT_GT(std::sqrt(centroid / fitted), 1.2);  // promised: about 1.4
}

TEST_F(DiscFit, ASlopeOfBrightnessDoesNotShiftTheCentre) {
  DiscRenderer scene(kSize, kSize, kGround + 10, 3);
  scene.AddSlope({0.4, -0.3});
  scene.AddEllipse(truth, kAmplitude);
  const auto dut = FitDisc(scene.Expose({0.7, 0}, rng), Start(truth));
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->ellipse.centre_px - truth.centre_px).norm(), 0.006);
}

TEST_F(DiscFit, ASpotCloseByDoesNotCountWhenItIsNamed) {
  DiscRenderer scene(kSize, kSize, kGround, 3);
  scene.AddEllipse(truth, kAmplitude);
  scene.AddEllipse(CircleAt(56, 40, 3), 60);
  const GreyImage image = scene.Expose({0.7, 0}, rng);
  const std::vector<Ellipse> others{CircleAt(56, 40, 5)};
  const auto dut = FitDisc(image, Start(truth), others);
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->ellipse.centre_px - truth.centre_px).norm(), 0.006);
  EXPECT_LT(dut->residual, 1.5);
}

TEST_F(DiscFit, ASmallDiscIsMeasuredToo) {
  const Ellipse small = CircleAt(40.2, 39.7, 2.5);
  const auto dut = FitDisc(Render(small, rng), Start(small, {0.2, 0.1}));
  ASSERT_TRUE(dut);
  EXPECT_LT((dut->ellipse.centre_px - small.centre_px).norm(), 0.02);
  EXPECT_NEAR(dut->ellipse.SemiMajor(), HalfLevel(2.5, 2.5, 0.7), 0.02);
}

TEST_F(DiscFit, WhatIsNotNearItsStartIsNoDisc) {
  const GreyImage image = Render(truth, rng);
  EXPECT_FALSE(FitDisc(image, Start(truth, {9, 9})));
  EXPECT_FALSE(FitDisc(GreyImage{kSize, kSize, std::vector<std::uint8_t>(kSize * kSize, 35)}, Start(truth)));
  DetectedDisc large = Start(truth);
  large.ellipse.shape_px2 *= 5;
  EXPECT_FALSE(FitDisc(image, large));
}

TEST_F(DiscFit, AWindowThatLeavesTheImageIsNotMeasured) {
  const Ellipse cut = CircleAt(11, 40, 9);
  EXPECT_FALSE(FitDisc(Render(cut, rng), Start(cut, {0, 0})));
  EXPECT_FALSE(FitDisc(GreyImage{}, Start(truth)));
  DetectedDisc none = Start(truth);
  none.ellipse.centre_px.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(FitDisc(Render(truth, rng), none));
}

TEST_F(DiscFit, WhereOthersHideAlmostEverythingNothingIsMeasured) {
  const std::vector<Ellipse> others{CircleAt(40, 40, 20)};
  EXPECT_FALSE(FitDisc(Render(truth, rng), Start(truth), others));
}

}  // namespace
}  // namespace priamos::head
