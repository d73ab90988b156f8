#include "head/core/edges/gradient_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "common/random.hpp"

namespace priamos::head {
namespace {

constexpr int kBorder = 4;  ///< beside it smoothing and Sobel do not see beyond the picture

/// Grey value `base` + `a` x + `b` y, which must stay within 0 to 255.
cv::Mat Ramp(int base, int a, int b, cv::Size size = {40, 30}) {
  cv::Mat image(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(base + a * x + b * y);
  return image;
}

cv::Mat WithNoise(const cv::Mat& image, double sigma, std::uint64_t seed) {
  Rng rng(seed);
  cv::Mat noisy = image.clone();
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      noisy.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(image.at<std::uint8_t>(y, x) + rng.Normal(sigma));
  return noisy;
}

GradientMap Of(const cv::Mat& image) {
  GradientMap map;
  map.Compute(image);
  return map;
}

/// Every pixel far enough from the border.
template <class Check>
void ForEachInside(const GradientMap& map, Check&& check) {
  for (int y = kBorder; y < map.height() - kBorder; ++y)
    for (int x = kBorder; x < map.width() - kBorder; ++x) check(x, y);
}

TEST(GradientMapTest, GradientsAreEightTimesTheSlope) {
  const struct {
    int base, a, b;
  } ramps[] = {{10, 3, 0}, {10, 0, 5}, {10, 2, 3}, {250, -2, -4}, {150, -3, 3}};
  for (const auto& r : ramps) {
    const GradientMap dut = Of(Ramp(r.base, r.a, r.b));
    ForEachInside(dut, [&](int x, int y) {
      ASSERT_EQ(dut.gx(y)[x], 8 * r.a) << x << ' ' << y;
      ASSERT_EQ(dut.gy(y)[x], 8 * r.b) << x << ' ' << y;
    });
  }
}

TEST(GradientMapTest, MagnitudeIsTheSumOfBothAmounts) {
  const GradientMap dut = Of(WithNoise(Ramp(30, 2, 3), 20, 1));
  for (int y = 0; y < dut.height(); ++y)
    for (int x = 0; x < dut.width(); ++x)
      ASSERT_EQ(dut.magnitude(y)[x], std::abs(dut.gx(y)[x]) + std::abs(dut.gy(y)[x]));
}

TEST(GradientMapTest, AFlatPictureHasNoGradientAndNoNoise) {
  const GradientMap dut = Of(cv::Mat(20, 33, CV_8UC1, cv::Scalar(77)));
  EXPECT_EQ(dut.width(), 33);
  EXPECT_EQ(dut.height(), 20);
  for (int y = 0; y < dut.height(); ++y)
    for (int x = 0; x < dut.width(); ++x) ASSERT_EQ(dut.magnitude(y)[x], 0);
  EXPECT_NEAR(dut.noise_sigma(), 0, 0.15) << "less than rounding to whole grey values makes";
  EXPECT_DOUBLE_EQ(dut.mean_grey(), 77);
  EXPECT_DOUBLE_EQ(dut.saturated_share(), 0);
}

TEST(GradientMapTest, NoiseIsThatOfThePixels) {
  for (const double sigma : {1.5, 3.0, 8.0}) {
    const cv::Mat flat(400, 400, CV_8UC1, cv::Scalar(128));
    const double with_rounding = std::hypot(sigma, std::sqrt(1.0 / 12));
    EXPECT_NEAR(Of(WithNoise(flat, sigma, 2)).noise_sigma(), with_rounding, 0.07 * sigma);
  }
}

TEST(GradientMapTest, ShadingAndEdgesAreNoNoise) {
  const cv::Mat flat(300, 300, CV_8UC1, cv::Scalar(100));
  const double plain = Of(WithNoise(flat, 3, 3)).noise_sigma();
  const cv::Mat shaded = Ramp(40, 1, 0, {200, 300});
  EXPECT_NEAR(Of(WithNoise(shaded, 3, 3)).noise_sigma(), plain, 0.3);
  cv::Mat striped = flat.clone();
  for (int x = 20; x < 280; x += 40) striped.colRange(x, x + 20).setTo(180);
  EXPECT_NEAR(Of(WithNoise(striped, 3, 3)).noise_sigma(), plain, 0.5);
}

TEST(GradientMapTest, TheNoiseOfGradientsIsWhatThePixelsMake) {
  const GradientMap dut = Of(WithNoise(cv::Mat(300, 300, CV_8UC1, cv::Scalar(128)), 6, 4));
  double squares_x = 0, squares_y = 0;
  int n = 0;
  ForEachInside(dut, [&](int x, int y) {
    squares_x += std::pow(dut.gx(y)[x], 2);
    squares_y += std::pow(dut.gy(y)[x], 2);
    ++n;
  });
  EXPECT_NEAR(std::sqrt(squares_x / n), dut.GradientNoise(), 0.1 * dut.GradientNoise());
  EXPECT_NEAR(std::sqrt(squares_y / n), dut.GradientNoise(), 0.1 * dut.GradientNoise());
}

TEST(GradientMapTest, BlackAndWhitePixelsAreSaturated) {
  cv::Mat image(64, 64, CV_8UC1, cv::Scalar(100));
  image.colRange(0, 16).setTo(0);
  image.colRange(16, 32).setTo(255);
  const GradientMap dut = Of(image);
  EXPECT_NEAR(dut.saturated_share(), 0.5, 0.03);
  EXPECT_NEAR(dut.mean_grey(), (0 + 255 + 2 * 100) / 4.0, 5);
  image.setTo(254);
  EXPECT_DOUBLE_EQ(Of(image).saturated_share(), 0);
  image.setTo(1);
  EXPECT_DOUBLE_EQ(Of(image).saturated_share(), 0);
}

TEST(GradientMapTest, ASmallerPictureLeavesNothingOfTheOneBefore) {
  GradientMap dut;
  dut.Compute(WithNoise(Ramp(20, 2, 2, {50, 50}), 20, 5));
  const cv::Mat small = WithNoise(Ramp(30, 3, 1, {24, 18}), 5, 6);
  dut.Compute(small);
  const GradientMap fresh = Of(small);
  ASSERT_EQ(dut.width(), 24);
  ASSERT_EQ(dut.height(), 18);
  EXPECT_DOUBLE_EQ(dut.noise_sigma(), fresh.noise_sigma());
  for (int y = 0; y < dut.height(); ++y)
    for (int x = 0; x < dut.width(); ++x) ASSERT_EQ(dut.magnitude(y)[x], fresh.magnitude(y)[x]);
}

}  // namespace
}  // namespace priamos::head
