#include "world/core/camera/defocus.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "world/core/camera/fine_grid.hpp"

namespace priamos::world {
namespace {

constexpr int kLeft = FineGrid::kWidth / 8, kRight = FineGrid::kWidth * 7 / 8;

/// Dark above, bright below.
cv::Mat Step() {
  cv::Mat light = cv::Mat::zeros(FineGrid::kHeight, FineGrid::kWidth, CV_32F);
  light.rowRange(light.rows / 2, light.rows).setTo(1);
  return light;
}

/// Standard deviation [px of the image] of the step in one column.
double SpreadAt(const cv::Mat& light, int column) {
  double sum = 0, moment = 0, square = 0;
  for (int y = 1; y < light.rows; ++y) {
    const double slope = light.at<float>(y, column) - light.at<float>(y - 1, column);
    sum += slope, moment += slope * y, square += slope * y * y;
  }
  const double mean = moment / sum;
  return std::sqrt(square / sum - mean * mean) / FineGrid::kScale;
}

TEST(Defocus, OneBlurIsThatOfTheKernel) {
  const cv::Mat dut = Blurred(Step(), cv::Mat(1, 1, CV_64F, cv::Scalar(1.5)));
  EXPECT_NEAR(SpreadAt(dut, kLeft), std::hypot(1.5, 1 / std::sqrt(12.0)), 0.01) << "and a pixel's width";
}

TEST(Defocus, EachPlaceHasItsOwnBlur) {
  cv::Mat sigma(4, 8, CV_64F, cv::Scalar(0.6));
  sigma.colRange(4, 8).setTo(2.4);
  const cv::Mat dut = Blurred(Step(), sigma);
  EXPECT_NEAR(SpreadAt(dut, kLeft), std::hypot(0.6, 1 / std::sqrt(12.0)), 0.02);
  EXPECT_NEAR(SpreadAt(dut, kRight), std::hypot(2.4, 1 / std::sqrt(12.0)), 0.02);
}

TEST(Defocus, NoLightIsLost) {
  cv::Mat sigma(3, 3, CV_64F, cv::Scalar(0.6)), light(FineGrid::kHeight, FineGrid::kWidth, CV_32F, 0.5F);
  sigma.at<double>(1, 1) = 3;
  cv::Mat off = cv::abs(Blurred(light, sigma) - 0.5);
  double worst = 0;
  cv::minMaxLoc(off, nullptr, &worst);
  EXPECT_LT(worst, 1e-5);
}

}  // namespace
}  // namespace priamos::world
