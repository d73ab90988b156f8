#include "head/core/edges/scale_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "common/random.hpp"

namespace priamos::head {
namespace {

constexpr double kSlope = 0.13;

/// Bright right of a line through (100.3, 100); its blur grows from `top_px` to `bottom_px`.
cv::Mat BlurredStep(double top_px, double bottom_px, double noise = 1) {
  Rng rng(4);
  cv::Mat image(200, 200, CV_8UC1);
  for (int y = 0; y < 200; ++y) {
    const double blur = top_px + (bottom_px - top_px) * y / 199;
    for (int x = 0; x < 200; ++x) {
      const double beside = (x - 100.3 - kSlope * (y - 100)) / std::hypot(1, kSlope);
      const double grey = 120 + 50 * std::erf(beside / blur / std::sqrt(2.0)) + rng.Normal(noise);
      image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(grey);
    }
  }
  return image;
}

double TotalLength(const BlurredEdges& found) {
  double sum = 0;
  for (const EdgeSegment& s : found.edges.segments) sum += s.length_px();
  return sum;
}

TEST(ScaleEdgeOperatorTest, EdgesOfAnyBlurAreFoundOnceWithTheirBlur) {
  ScaleEdgeOperator dut;
  for (const double blur : {0.6, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0}) {
    BlurredEdges found;
    dut.Extract(BlurredStep(blur, blur), found);
    ASSERT_EQ(found.edges.segments.size(), 1u) << blur;
    ASSERT_EQ(found.blur_px.size(), 1u);
    const EdgeSegment& s = found.edges.segments[0];
    EXPECT_GT(s.length_px(), 170) << blur;
    EXPECT_NEAR(found.blur_px[0], blur, 0.1 + 0.08 * blur);
    const double aside = s.centre.x() - 100.3 - kSlope * (s.centre.y() - 100);
    EXPECT_NEAR(aside, 0, 0.08) << blur;
    EXPECT_LT(std::abs(aside), 4 * s.sigma_normal_px + 0.01) << blur;
  }
}

TEST(ScaleEdgeOperatorTest, ASofterEdgeIsLessExact) {
  ScaleEdgeOperator dut;
  BlurredEdges sharp, soft;
  dut.Extract(BlurredStep(1, 1, 3), sharp);
  dut.Extract(BlurredStep(5, 5, 3), soft);
  ASSERT_EQ(sharp.edges.segments.size(), 1u);
  ASSERT_EQ(soft.edges.segments.size(), 1u);
  EXPECT_GT(soft.edges.segments[0].sigma_normal_px, 2 * sharp.edges.segments[0].sigma_normal_px);
}

TEST(ScaleEdgeOperatorTest, AnEdgeThatGrowsSofterIsFoundOverItsWholeLength) {
  ScaleEdgeOperator dut;
  BlurredEdges found;
  dut.Extract(BlurredStep(0.6, 6), found);
  EXPECT_GT(TotalLength(found), 165);
  EXPECT_LT(TotalLength(found), 215) << "and nowhere twice";
}

TEST(ScaleEdgeOperatorTest, SharpEdgesAreThoseOfTheEdgeOperator) {
  const cv::Mat image = BlurredStep(0.7, 0.7);
  BlurredEdges found;
  ScaleEdgeOperator().Extract(image, found);
  EdgeImage expected;
  EdgeOperator().Extract(image, expected);
  ASSERT_EQ(found.edges.segments.size(), expected.segments.size());
  for (std::size_t i = 0; i < expected.segments.size(); ++i) {
    EXPECT_EQ(found.edges.segments[i].begin, expected.segments[i].begin);
    EXPECT_EQ(found.edges.segments[i].end, expected.segments[i].end);
  }
}

TEST(ScaleEdgeOperatorTest, PointsOfASoftEdgeLieOnIt) {
  BlurredEdges found;
  ScaleEdgeOperator().Extract(BlurredStep(4, 4), found);
  ASSERT_EQ(found.edges.segments.size(), 1u);
  EXPECT_GE(found.edges.segments[0].n_points, 5);
  for (const EdgePoint& p : found.edges.points) {
    EXPECT_NEAR(p.at.x(), 100.3 + kSlope * (p.at.y() - 100), 0.5);
  }
}

TEST(ScaleEdgeOperatorTest, NothingIsFoundInNoiseAndInConstantImages) {
  Rng rng(3);
  cv::Mat noise(576, 768, CV_8UC1);
  for (int i = 0; i < 576 * 768; ++i) noise.data[i] = cv::saturate_cast<std::uint8_t>(128 + rng.Normal(12));
  ScaleEdgeOperator dut;
  BlurredEdges found;
  dut.Extract(noise, found);
  EXPECT_LE(found.edges.segments.size(), 3u);
  for (const double grey : {0.0, 128.0, 255.0}) {
    dut.Extract(cv::Mat(100, 101, CV_8UC1, cv::Scalar(grey)), found);
    EXPECT_TRUE(found.edges.segments.empty());
    EXPECT_TRUE(found.blur_px.empty());
  }
}

TEST(ScaleEdgeOperatorTest, SmallImagesHaveFewerScalesAndTinyOnesAreRefused) {
  ScaleEdgeOperator dut;
  BlurredEdges found;
  for (const int side : {32, 33, 63, 64, 65, 127, 129}) {
    EXPECT_NO_THROW(dut.Extract(BlurredStep(1, 1)({60, 60, side, side}), found)) << side;
    EXPECT_EQ(found.blur_px.size(), found.edges.segments.size());
  }
  EXPECT_THROW(dut.Extract(cv::Mat(16, 16, CV_8UC1, cv::Scalar(0)), found), std::invalid_argument);
}

TEST(BlurredEdgesTest, TheMedianBlurIsThatOfHalfTheLength) {
  const auto edge = [](double length_px) {
    EdgeSegment segment;
    segment.end = {length_px, 0};
    return segment;
  };
  BlurredEdges dut;
  EXPECT_EQ(dut.MedianBlur(), 0);
  dut.edges.segments = {edge(10), edge(100), edge(30)};
  dut.blur_px = {0.2, 2.5, 7};
  EXPECT_EQ(dut.MedianBlur(), 2.5);
}

}  // namespace
}  // namespace priamos::head
