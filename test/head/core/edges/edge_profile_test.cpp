#include "head/core/edges/edge_profile.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "common/random.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using support::Between;

/// Grey values `of` the distance from column 32; what rounding takes from one row it gives to another.
cv::Mat Columns(const std::function<double(double)>& of) {
  constexpr int kRows = 64;
  cv::Mat image(kRows, 64, CV_8UC1);
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < 64; ++x)
      image.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(std::floor(of(x - 32) + (y + 0.5) / kRows));
  return image;
}

cv::Mat Noise(int width, int height, std::uint64_t seed) {
  Rng rng(seed);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(rng.Below(256));
  return image;
}

AxisLine Upright(double at, int sign = 1) {
  AxisLine line{.sign = sign, .offset = at};
  line.ChooseKernels();
  return line;
}

AxisLine Slanting(double origin, double offset, double slope, bool steep = true) {
  AxisLine line{.steep = steep, .origin = origin, .offset = offset, .slope = slope};
  line.ChooseKernels();
  return line;
}

EdgeSums Sum(const cv::Mat& image, const AxisLine& line, int first, int last) {
  EdgeProfile dut;
  dut.SetImage(image);
  return dut.Sum(line, first, last);
}

TEST(EdgeProfileTest, SumsAreTheDerivativesOfTheGreyValues) {
  // 128 + 6 d + 2 d^2 / 2 - 0.5 d^3 / 6, whose derivatives at d = 0 a smoothing changes in a known way: a
  // Gaussian and a box leave the second and the third as they are.
  const auto parabola = Sum(Columns([](double d) { return 100 + d * d; }), Upright(32), 0, 63);
  EXPECT_NEAR(parabola.strength / 64, 0, 0.05);
  EXPECT_NEAR(parabola.imbalance[0] / 64, 2, 0.03);
  EXPECT_NEAR(parabola.imbalance[1] / 64, 2, 0.03);
  const auto ramp = Sum(Columns([](double d) { return 128 + 6 * d; }), Upright(32.3), 0, 63);
  EXPECT_NEAR(ramp.strength / 64, 6, 0.03);
  EXPECT_NEAR(ramp.imbalance[0] / 64, 0, 0.02);
  EXPECT_NEAR(ramp.sharpness[0] / 64, 0, 0.02);
  const auto cubic = Sum(Columns([](double d) { return 128 - d * d * d / 6 / 2; }), Upright(32), 0, 63);
  EXPECT_NEAR(cubic.sharpness[0] / 64, 0.5, 0.03);
  EXPECT_NEAR(cubic.sharpness[1] / 64, 0.5, 0.03);
}

TEST(EdgeProfileTest, TheSignIsThatOfTheContrastWanted) {
  const cv::Mat image = Columns([](double d) { return 110 + 50 * std::erf((d - 0.2) / 1.1); });
  const EdgeSums plus = Sum(image, Upright(32), 10, 40), minus = Sum(image, Upright(32, -1), 10, 40);
  EXPECT_GT(plus.strength, 0);
  EXPECT_GT(plus.sharpness[0], 0);
  EXPECT_FLOAT_EQ(minus.strength, -plus.strength);
  for (int i = 0; i < 2; ++i) {
    EXPECT_FLOAT_EQ(minus.imbalance[i], -plus.imbalance[i]);
    EXPECT_FLOAT_EQ(minus.sharpness[i], -plus.sharpness[i]);
  }
  EXPECT_FLOAT_EQ(minus.low, plus.low);
  EXPECT_FLOAT_EQ(minus.high, plus.high);
}

TEST(EdgeProfileTest, TheQuotientTellsHowFarBesideTheLineTheEdgeLies) {
  for (const double beside : {-0.3, -0.1, 0.0, 0.013, 0.2}) {
    for (const double at : {31.6, 32.0, 32.01, 32.49}) {
      const cv::Mat image =
          Columns([&](double d) { return 110 + 50 * std::erf((d - (at - 32) - beside) / 1.1); });
      const EdgeSums sums = Sum(image, Upright(at), 0, 63);
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(sums.imbalance[i] / sums.sharpness[i], beside, 0.008 + 0.14 * std::abs(beside));
    }
  }
}

TEST(EdgeProfileTest, BothSidesAreGreyAsTheyAre) {
  const EdgeSums sums = Sum(Columns([](double d) { return d < 0 ? 40 : 200; }), Upright(31.5), 5, 24);
  EXPECT_FLOAT_EQ(sums.rows, 20);
  EXPECT_FLOAT_EQ(sums.low, 20 * 40);
  EXPECT_FLOAT_EQ(sums.high, 20 * 200);
  EXPECT_FLOAT_EQ(sums.inverse, 1 / sums.strength);
  EXPECT_FLOAT_EQ(sums.along, (5 + 24) / 2.0F);
}

TEST(EdgeProfileTest, GreyValuesAreTakenFourPixelsBeside) {
  const EdgeSums sums = Sum(Columns([](double d) { return 128 + 4 * d; }), Upright(31.5), 0, 63);
  EXPECT_NEAR(sums.low / 64, 128 + 4 * (31.5 - 4 - 32), 0.1);
  EXPECT_NEAR(sums.high / 64, 128 + 4 * (31.5 + 4 - 32), 0.1);
}

TEST(EdgeProfileTest, WhereNothingIsThereIsNoStrength) {
  const EdgeSums sums = Sum(cv::Mat(64, 64, CV_8UC1, cv::Scalar(90)), Upright(30.2), 0, 63);
  EXPECT_NEAR(sums.strength / 64, 0, 0.01);
  EXPECT_NEAR(sums.imbalance[0] / 64, 0, 0.03);
  EXPECT_NEAR(sums.sharpness[1] / 64, 0, 0.1);
}

TEST(EdgeProfileTest, RowsOutsideOfThePictureAreLeftOut) {
  const cv::Mat image = Noise(50, 40, 1);
  const EdgeSums all = Sum(image, Upright(25), -10, 100), inside = Sum(image, Upright(25), 0, 39);
  EXPECT_FLOAT_EQ(all.rows, 40);
  EXPECT_FLOAT_EQ(all.strength, inside.strength);
  EXPECT_FLOAT_EQ(Sum(image, Upright(25), 41, 60).rows, 0);
}

TEST(EdgeProfileTest, LinesNearTheSidesOfThePictureAreNotMeasured) {
  const cv::Mat image = Noise(50, 40, 2);
  const double first = EdgeKernel::kCentre, last = 50 - (EdgeKernel::kTaps - EdgeKernel::kCentre);
  for (const double at : {-5.0, first - 0.1, last + 1, 60.0}) {
    const EdgeSums sums = Sum(image, Upright(at), 0, 39);
    EXPECT_FLOAT_EQ(sums.rows, 0) << at;
    EXPECT_FLOAT_EQ(sums.strength, 0) << at;
    EXPECT_FLOAT_EQ(sums.inverse, 0) << at;
  }
  for (const double at : {first, 20.0, last + 0.9})
    EXPECT_FLOAT_EQ(Sum(image, Upright(at), 0, 39).rows, 40) << at;
}

TEST(EdgeProfileTest, ASlantingLineIsMeasuredWhereItIsInside) {
  const cv::Mat image = Noise(48, 80, 3);
  const AxisLine line = Slanting(40, 24, 0.7);
  int rows = 0, sum = 0;
  for (int y = 0; y < 80; ++y) {
    const double x = std::floor(24 + 0.7 * (y - 40));
    if (x < EdgeKernel::kCentre || x + EdgeKernel::kTaps - EdgeKernel::kCentre > 48) continue;
    ++rows;
    sum += y;
  }
  const EdgeSums sums = Sum(image, line, 0, 79);
  EXPECT_NEAR(sums.rows, rows, 1);
  EXPECT_NEAR(sums.along, double(sum) / rows, 0.6);
}

RC_GTEST_PROP(EdgeProfileTest, FlatLinesAreMeasuredAsSteepOnesOfTheTransposedPicture, ()) {
  const int width = *rc::gen::inRange(32, 90), height = *rc::gen::inRange(32, 90);
  const cv::Mat image = Noise(width, height, *rc::gen::inRange(0, 1000));
  const double offset = Between(8, height - 10), slope = Between(-1, 1);
  const EdgeSums flat = Sum(image, Slanting(width / 2.0, offset, slope, false), 0, width - 1);
  const EdgeSums steep = Sum(image.t(), Slanting(width / 2.0, offset, slope), 0, width - 1);
  RC_ASSERT(flat.rows == steep.rows);
  RC_ASSERT(flat.along == steep.along);
  RC_ASSERT(flat.strength == steep.strength);
  RC_ASSERT(flat.imbalance[0] == steep.imbalance[0] && flat.imbalance[1] == steep.imbalance[1]);
  RC_ASSERT(flat.sharpness[0] == steep.sharpness[0] && flat.sharpness[1] == steep.sharpness[1]);
  RC_ASSERT(flat.low == steep.low && flat.high == steep.high);
}

TEST(EdgeProfileTest, TheExtentIsThatAlongTheLine) {
  EdgeProfile dut;
  dut.SetImage(Noise(50, 40, 4));
  EXPECT_EQ(dut.Extent({.steep = true}), 40);
  EXPECT_EQ(dut.Extent({.steep = false}), 50);
}

TEST(EdgeSumsTest, PartsAddUpToTheWhole) {
  const cv::Mat image = Noise(64, 64, 5);
  const AxisLine line = Upright(30.5 + 1.0 / 128);  // in the middle of a phase, where nothing is corrected
  EdgeSums sums = Sum(image, line, 4, 20);
  const EdgeSums rest = Sum(image, line, 21, 50), whole = Sum(image, line, 4, 50);
  const float along = sums.along, inverse = sums.inverse;
  sums.Add(rest);
  EXPECT_FLOAT_EQ(sums.rows, 47);
  EXPECT_NEAR(sums.strength, whole.strength, 1e-2);
  EXPECT_FLOAT_EQ(sums.low, whole.low);
  EXPECT_FLOAT_EQ(sums.high, whole.high);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(sums.imbalance[i], whole.imbalance[i], 1e-2);
    EXPECT_NEAR(sums.sharpness[i], whole.sharpness[i], 1e-2);
  }
  EXPECT_FLOAT_EQ(sums.along, along);
  EXPECT_FLOAT_EQ(sums.inverse, inverse);
}

TEST(AxisLineTest, PassesItsOffsetAtItsOrigin) {
  const AxisLine steep = Slanting(100, 40, 0.75), flat = Slanting(100, 40, 0.75, false);
  EXPECT_DOUBLE_EQ(steep.Across(100), 40);
  EXPECT_DOUBLE_EQ(steep.Across(104), 43);
  EXPECT_DOUBLE_EQ(steep.Stretch(), 1.25);
  EXPECT_EQ(steep.Point(104, 43), Eigen::Vector2d(43, 104));
  EXPECT_EQ(flat.Point(104, 43), Eigen::Vector2d(104, 43));
  EXPECT_GT(steep.kernels(KernelWidth::kWide).sigma_px, steep.kernels(KernelWidth::kNarrow).sigma_px);
}

}  // namespace
}  // namespace priamos::head
