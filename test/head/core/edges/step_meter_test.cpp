#include "head/core/edges/step_meter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace priamos::head {
namespace {

/// Upright bands of grey values that change at each of `places`, blurred by `blur_px`.
cv::Mat Bands(const std::vector<double>& places, const std::vector<double>& greys, double blur_px) {
  cv::Mat image(160, 200, CV_32F);
  for (int x = 0; x < image.cols; ++x) {
    double grey = greys[0];
    for (std::size_t i = 0; i < places.size(); ++i)
      grey += (greys[i + 1] - greys[i]) * std::clamp(x + 0.5 - places[i], 0.0, 1.0);
    image.col(x) = grey;
  }
  if (blur_px > 0) cv::GaussianBlur(image, image, {0, 0}, blur_px);
  image.convertTo(image, CV_8U);
  return image;
}

const Eigen::Vector2d kRight(1, 0);

TEST(StepMeterTest, ABlurredStepIsFoundWhereItIs) {
  const StepMeter dut(Bands({100.8}, {60, 160}, 3), 1, 3);
  const auto step = dut.Measure({99, 80}, kRight, 10, {});
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->shift_px, 1.8, 0.2);
  EXPECT_NEAR(step->contrast, 100, 5);
  EXPECT_GT(step->explained, 0.99);
}

TEST(StepMeterTest, ItsSignIsThatOfTheRiseAlongTheNormal) {
  const StepMeter dut(Bands({100}, {60, 160}, 0), 1, 0);
  const auto step = dut.Measure({100, 80}, -kRight, 10, {});
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->contrast, -100, 10);
}

TEST(StepMeterTest, OfTwoStepsThatMergeEachIsMeasuredWhereItIs) {
  const StepMeter dut(Bands({98, 103}, {60, 160, 90}, 3), 1, 3);
  const double beside[] = {5};
  const auto both = dut.Measure({97.5, 80}, kRight, 10, beside);
  ASSERT_TRUE(both);
  EXPECT_NEAR(both->shift_px, 0.5, 0.3);
  EXPECT_NEAR(both->contrast, 100, 12);
  const auto alone = dut.Measure({97.5, 80}, kRight, 10, {});
  ASSERT_TRUE(alone);
  EXPECT_GT(both->explained, alone->explained) << "the other step is not one of its own";
}

TEST(StepMeterTest, AnEvenSurfaceHasNoStep) {
  const StepMeter dut(Bands({20}, {60, 160}, 3), 1, 3);
  const auto step = dut.Measure({100, 80}, kRight, 10, {});
  ASSERT_TRUE(step);
  EXPECT_NEAR(step->contrast, 0, 1);
  EXPECT_LT(step->steepest, 1);
}

TEST(StepMeterTest, NothingIsMeasuredAtTheBorder) {
  const StepMeter dut(Bands({100}, {60, 160}, 3), 1, 3);
  EXPECT_FALSE(dut.Measure({3, 80}, kRight, 10, {}));
  EXPECT_FALSE(dut.Measure({100, 158}, kRight, 10, {}));
}

}  // namespace
}  // namespace priamos::head
