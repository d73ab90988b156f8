#include "head/core/edges/edge_refit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

/// Bright right of column 100, but for rows 90 to 109: these show nothing.
cv::Mat StepWithAGap() {
  cv::Mat image(200, 200, CV_8UC1, cv::Scalar(60));
  image.colRange(100, 200).setTo(160);
  image.rowRange(90, 110).setTo(60);
  return image;
}

TEST(EdgeRefinerTest, RowsThatShowNothingCountForNothing) {
  EdgeRefiner dut;
  dut.SetImage(StepWithAGap(), 1);
  EdgeImage out;
  ASSERT_TRUE(dut.Refine({.x1 = 99.7, .y1 = 160, .x2 = 99.3, .y2 = 40}, {}, out));
  const EdgeSegment& segment = out.segments.at(0);
  EXPECT_NEAR(segment.begin.x(), 99.5, 0.02);
  EXPECT_NEAR(segment.end.x(), 99.5, 0.02);
  EXPECT_GT(segment.length_px(), 115);
  for (const EdgePoint& point : out.points) EXPECT_TRUE(point.at.allFinite());
}

/// Blurred step through (100, 100); `angle_rad` turns the bright side, which is on the right at 0 and below
/// at pi/2.
cv::Mat Step(double angle_rad, double contrast = 100, double blur_px = 0.8) {
  cv::Mat image(200, 200, CV_8UC1);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double beside = std::cos(angle_rad) * (x - 100) + std::sin(angle_rad) * (y - 100);
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
          std::lround(120 + contrast / 2 * std::erf(beside / blur_px / std::sqrt(2.0))));
    }
  }
  return image;
}

/// The edge of Step, 60 px to either side of its middle, `aside_px` beside it: bright on the right hand.
RoughLine Near(double angle_rad, double aside_px = 0.6) {
  const double nx = std::cos(angle_rad), ny = std::sin(angle_rad);
  const double x = 100 + aside_px * nx, y = 100 + aside_px * ny;
  return {x - 60 * ny, y + 60 * nx, x + 60 * ny, y - 60 * nx};
}

bool Refine(const cv::Mat& image, const RoughLine& rough, EdgeImage& out,
            const EdgeRefiner::Options& options = {}, double noise = 1) {
  EdgeRefiner dut;
  dut.SetImage(image, noise);
  return dut.Refine(rough, options, out);
}

TEST(EdgeRefinerTest, GreyValuesAreThoseOfBothSides) {
  for (const double angle : {0.0, kPi / 2, kPi, -kPi / 2}) {
    EdgeImage out;
    ASSERT_TRUE(Refine(Step(angle), Near(angle), out));
    EXPECT_NEAR(out.segments[0].grey_left, 70, 1);
    EXPECT_NEAR(out.segments[0].grey_right, 170, 1);
  }
}

TEST(EdgeRefinerTest, PointsOfASegmentLieOnItInTheirPlaceOfTheList) {
  EdgeImage out;
  out.points.resize(7);  // of segments before
  ASSERT_TRUE(Refine(Step(0.3), Near(0.3), out));
  const EdgeSegment& s = out.segments[0];
  EXPECT_EQ(s.first_point, 7);
  EXPECT_EQ(s.first_point + s.n_points, int(out.points.size()));
  ASSERT_GT(s.n_points, 5);
  for (int i = s.first_point; i < int(out.points.size()); ++i) {
    EXPECT_LT(std::abs(s.normal().dot(out.points[i].at - s.centre)), 0.05);
    EXPECT_GT(out.points[i].sigma_normal_px, EdgeRefiner::Options().floor_px);
  }
}

TEST(EdgeRefinerTest, ShortLinesAreRefused) {
  cv::Mat image(200, 200, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(100, 90, 60, 20)).setTo(160);
  const RoughLine side{.x1 = 99.5, .y1 = 109, .x2 = 99.5, .y2 = 90};
  EdgeImage out;
  EXPECT_TRUE(Refine(image, side, out, {.min_length_px = 16}));
  EXPECT_FALSE(Refine(image, side, out, {.min_length_px = 24}));
  const RoughLine overlong{.x1 = 99.5, .y1 = 115, .x2 = 99.5, .y2 = 84};
  EXPECT_FALSE(Refine(image, overlong, out, {.min_length_px = 24}));
  EXPECT_EQ(out.segments.size(), 1u) << "what is refused leaves nothing";
}

TEST(EdgeRefinerTest, FaintEdgesAreRefused) {
  EdgeImage out;
  EXPECT_TRUE(Refine(Step(0.2, 20), Near(0.2), out, {.min_contrast = 15}));
  EXPECT_FALSE(Refine(Step(0.2, 20), Near(0.2), out, {.min_contrast = 25}));
  EXPECT_FALSE(Refine(Step(0.2, 20), Near(0.2), out, {.min_contrast = 15}, 300)) << "drowned in noise";
}

TEST(EdgeRefinerTest, SoftShadowsAreRefused) {
  EdgeImage out;
  EXPECT_TRUE(Refine(Step(0.2, 100, 1.5), Near(0.2), out));
  EXPECT_FALSE(Refine(Step(0.2, 100, 4), Near(0.2), out));
  EXPECT_TRUE(Refine(Step(0.2, 100, 4), Near(0.2), out, {.max_spread_px = 6}));
}

TEST(EdgeRefinerTest, AnEdgeOfTheOtherContrastIsRefused) {
  RoughLine back = Near(0.2);
  std::swap(back.x1, back.x2);
  std::swap(back.y1, back.y2);
  EdgeImage out;
  EXPECT_FALSE(Refine(Step(0.2), back, out));
}

TEST(EdgeRefinerTest, MoreNoiseMakesLargerErrors) {
  EdgeImage quiet, noisy;
  ASSERT_TRUE(Refine(Step(0.2), Near(0.2), quiet, {.floor_px = 0}, 2));
  ASSERT_TRUE(Refine(Step(0.2), Near(0.2), noisy, {.floor_px = 0}, 8));
  EXPECT_GT(noisy.segments[0].sigma_normal_px, 3 * quiet.segments[0].sigma_normal_px);
  EXPECT_GT(noisy.segments[0].sigma_angle_rad, 3 * quiet.segments[0].sigma_angle_rad);
  EdgeImage floored;
  ASSERT_TRUE(Refine(Step(0.2), Near(0.2), floored, {.floor_px = 0.5}, 2));
  EXPECT_NEAR(floored.segments[0].sigma_normal_px, 0.5, 0.01);
}

}  // namespace
}  // namespace priamos::head
