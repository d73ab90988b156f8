#include "head/core/calibration/discs/disc_window.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <set>

#include "common/geometry.hpp"
#include "test/support/ellipses.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using support::Between;
using support::CircleAt;
using support::EllipseAt;

constexpr int kWidth = 64, kHeight = 48;

GreyImage BlankImage() {
  return {kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight, 0)};
}

/// The value of a pixel tells its place.
GreyImage NumberedImage() {
  GreyImage image = BlankImage();
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) image.pixels[v * kWidth + u] = static_cast<std::uint8_t>(u + 4 * v);
  return image;
}

/// Wholly within the blank image.
Ellipse AnyEllipse() {
  const double major = Between(2, 14), minor = major * Between(0.35, 1);
  const Eigen::Vector2d centre(Between(15, kWidth - 16), Between(15, kHeight - 16));
  return EllipseAt(centre, major, minor, Between(0, kPi));
}

/// In units of the semi-axes: 1 on the rim.
double RadiusOf(const Ellipse& e, double u, double v) {
  const Eigen::Vector2d d = Eigen::Vector2d(u, v) - e.centre_px;
  return std::sqrt(d.dot(e.shape_px2.inverse() * d));
}

TEST(DiscWindow, ACircleGrowsByAsManyPixelsAsAskedFor) {
  const Ellipse dut = Grown(CircleAt(20, 10, 7), 2.5);
  EXPECT_EQ(dut.centre_px, Eigen::Vector2d(20, 10));
  EXPECT_NEAR(dut.SemiMajor(), 9.5, 1e-12);
  EXPECT_NEAR(dut.SemiMinor(), 9.5, 1e-12);
}

RC_GTEST_PROP(DiscWindow, AnEllipseGrowsInProportionAndByThePixelsInTheMean, ()) {
  const Ellipse start = AnyEllipse();
  const double px = Between(0, 5);
  const Ellipse dut = Grown(start, px);
  const double mean = std::sqrt(start.SemiMajor() * start.SemiMinor());
  RC_ASSERT(dut.centre_px == start.centre_px);
  RC_ASSERT(std::abs(std::sqrt(dut.SemiMajor() * dut.SemiMinor()) - (mean + px)) < 1e-9);
  RC_ASSERT(std::abs(dut.SemiMinor() / dut.SemiMajor() - start.SemiMinor() / start.SemiMajor()) < 1e-9);
}

TEST(DiscWindow, ASpotWithoutExtentDoesNotGrowBeyondBounds) {
  const Ellipse dut = Grown(CircleAt(20, 10, 1e-6), 2);
  EXPECT_TRUE(dut.shape_px2.allFinite());
  EXPECT_LT(dut.SemiMajor(), 1);
}

RC_GTEST_PROP(DiscWindow, WithinIsWhatIsNearerThanTheRim, ()) {
  const Ellipse e = AnyEllipse();
  const double u = Between(0, kWidth), v = Between(0, kHeight);
  RC_PRE(std::abs(RadiusOf(e, u, v) - 1) > 1e-6);
  RC_ASSERT(Within(e, u, v) == (RadiusOf(e, u, v) < 1));
}

RC_GTEST_PROP(DiscWindow, TheBoxHoldsTheEllipseAndNothingToSpare, ()) {
  const Ellipse e = AnyEllipse();
  const auto dut = BoundingBox(BlankImage(), e);
  RC_ASSERT(dut.has_value());
  const Eigen::Matrix2d root = e.shape_px2.llt().matrixL();
  Eigen::Vector2d low = e.centre_px, high = e.centre_px;
  for (int i = 0; i < 3600; ++i) {
    const double t = 2 * kPi * i / 3600;
    const Eigen::Vector2d rim = e.centre_px + root * Eigen::Vector2d(std::cos(t), std::sin(t));
    low = low.cwiseMin(rim);
    high = high.cwiseMax(rim);
  }
  // The whole pixels between the outermost points of the rim.
  constexpr double kSlack = 1e-4;
  RC_ASSERT(dut->u0 > low.x() - kSlack && dut->u0 < low.x() + 1 + kSlack);
  RC_ASSERT(dut->v0 > low.y() - kSlack && dut->v0 < low.y() + 1 + kSlack);
  RC_ASSERT(dut->u1 < high.x() + kSlack && dut->u1 > high.x() - 1 - kSlack);
  RC_ASSERT(dut->v1 < high.y() + kSlack && dut->v1 > high.y() - 1 - kSlack);
}

TEST(DiscWindow, AnEllipseThatLeavesTheImageHasNoBox) {
  const GreyImage image = BlankImage();
  EXPECT_TRUE(BoundingBox(image, CircleAt(10, 10, 10)));
  EXPECT_FALSE(BoundingBox(image, CircleAt(10, 20, 10.01)));
  EXPECT_FALSE(BoundingBox(image, CircleAt(20, 10, 10.01)));
  EXPECT_TRUE(BoundingBox(image, CircleAt(kWidth - 11, kHeight - 11, 10)));
  EXPECT_FALSE(BoundingBox(image, CircleAt(kWidth - 11, 20, 10.01)));
  EXPECT_FALSE(BoundingBox(image, CircleAt(20, kHeight - 11, 10.01)));
}

TEST(DiscWindow, NumbersThatAreNoneHaveNoBox) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const GreyImage image = BlankImage();
  EXPECT_FALSE(BoundingBox(image, CircleAt(nan, 20, 5)));
  EXPECT_FALSE(BoundingBox(image, CircleAt(20, 20, nan)));
  EXPECT_FALSE(BoundingBox(image, {{20, 20}, -25 * Eigen::Matrix2d::Identity()}));
  EXPECT_FALSE(BoundingBox(GreyImage{}, CircleAt(20, 20, 5)));
}

RC_GTEST_PROP(DiscWindow, EveryPixelOfTheEllipseIsVisitedOnceWithItsGreyValue, ()) {
  const GreyImage image = NumberedImage();
  const Ellipse e = AnyEllipse();
  std::set<std::pair<int, int>> visited;
  int wrong = 0;
  ForEachPixel(image, *BoundingBox(image, e), e, {}, [&](double dx, double dy, double q2, int grey) {
    const double u = e.centre_px.x() + dx, v = e.centre_px.y() + dy;
    const int column = static_cast<int>(std::lround(u)), row = static_cast<int>(std::lround(v));
    wrong += grey != image.pixels[row * kWidth + column];
    wrong += std::abs(std::sqrt(q2) - RadiusOf(e, u, v)) > 1e-6;
    wrong += !visited.insert({column, row}).second;
  });
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const double radius = RadiusOf(e, u, v);
      if (std::abs(radius - 1) > 1e-6) wrong += visited.contains({u, v}) != (radius < 1);
    }
  RC_ASSERT(wrong == 0);
}

TEST(DiscWindow, PixelsOfOtherSpotsAreNotVisited) {
  const GreyImage image = BlankImage();
  const Ellipse e = CircleAt(24, 24, 10);
  const std::vector<Ellipse> others{CircleAt(33, 24, 4), CircleAt(24, 12, 5)};
  int visited = 0, hidden = 0;
  ForEachPixel(image, *BoundingBox(image, e), e, others, [&](double dx, double dy, double, int) {
    ++visited;
    for (const Ellipse& other : others) hidden += RadiusOf(other, 24 + dx, 24 + dy) < 1;
  });
  EXPECT_EQ(hidden, 0);
  EXPECT_GT(visited, 200);  // of about 314
  EXPECT_LT(visited, 300);
}

}  // namespace
}  // namespace priamos::head
