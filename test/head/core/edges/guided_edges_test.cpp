#include "head/core/edges/guided_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/random.hpp"
#include "head/core/edges/edge_segments.hpp"

namespace priamos::head {
namespace {

/// An image of 320x240, grey 120, brighter by `contrast` to the right of the line from (150.5, -0.5) to
/// (170.5, 239.5), between the rows `first` and `last`, blurred, with noise of one grey value.
cv::Mat Step(double contrast, double blur_px, int first = 0, int last = 239) {
  cv::Mat image(240, 320, CV_32FC1, cv::Scalar(120));
  for (int v = first; v <= last; ++v) {
    const double edge = 151 + (v + 0.5) * 20 / 240;  // of pixel borders counted from 0
    for (int u = 0; u < image.cols; ++u)
      image.at<float>(v, u) += static_cast<float>(contrast * std::clamp(u + 1 - edge, 0.0, 1.0));
  }
  if (blur_px > 0) cv::GaussianBlur(image, image, {0, 0}, blur_px);
  Rng rng(5);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) image.at<float>(v, u) += static_cast<float>(rng.Normal(1));
  cv::Mat grey;
  image.convertTo(grey, CV_8UC1);
  return grey;
}

/// Point of the drawn line at row `v`.
Eigen::Vector2d OnLine(double v) {
  return {150.5 + (v + 0.5) * 20 / 240, v};
}

/// Largest distance of the segment's ends from the drawn line.
double Off(const EdgeSegment& segment) {
  const Eigen::Vector2d direction = (OnLine(200) - OnLine(0)).normalized(),
                        normal(-direction.y(), direction.x());
  return std::max(std::abs(normal.dot(segment.begin - OnLine(0))),
                  std::abs(normal.dot(segment.end - OnLine(0))));
}

TEST(GuidedEdgesTest, AFaintEdgeIsMeasuredThatTheOperatorDoesNotLink) {
  const cv::Mat image = Step(5, 0);
  EdgeImage linked;
  EdgeOperator().Extract(image, linked);
  EXPECT_TRUE(linked.segments.empty());
  EdgeImage out;
  GuidedEdges dut(image, 1, 0);
  ASSERT_TRUE(dut.Measure(OnLine(20), OnLine(220), out));
  ASSERT_EQ(out.segments.size(), 1u);
  EXPECT_LT(Off(out.segments[0]), 0.3);
  EXPECT_NEAR(out.segments[0].contrast(), 5, 1.5);
  EXPECT_EQ(out.segments[0].n_points, static_cast<int>(out.points.size()));
}

TEST(GuidedEdgesTest, ABlurredEdgeIsMeasuredToATenthOfAPixel) {
  for (const double blur_px : {2.0, 3.0, 5.0}) {
    EdgeImage out;
    GuidedEdges dut(Step(60, blur_px), 1, blur_px);
    const Eigen::Vector2d aside(1, 0);
    ASSERT_TRUE(dut.Measure(OnLine(20) + aside, OnLine(220) + aside, out)) << blur_px;
    EXPECT_LT(Off(out.segments[0]), 0.1) << blur_px;
    EXPECT_GT(out.segments[0].sigma_normal_px, 0);
  }
}

TEST(GuidedEdgesTest, TheBrightSideIsWhereItIs) {
  for (const double contrast : {40.0, -40.0}) {
    EdgeImage out;
    GuidedEdges dut(Step(contrast, 1), 1, 1);
    ASSERT_TRUE(dut.Measure(OnLine(20), OnLine(220), out));
    EXPECT_GT(out.segments[0].contrast(), 30);
    EXPECT_GT(out.segments[0].normal().x() * contrast, 0) << "towards the bright side";
  }
}

TEST(GuidedEdgesTest, AnEdgeThatEndsEarlierIsNotMadeLonger) {
  EdgeImage out;
  GuidedEdges dut(Step(60, 1, 0, 119), 1, 1);
  ASSERT_TRUE(dut.Measure(OnLine(20), OnLine(170), out));
  EXPECT_NEAR(std::max(out.segments[0].begin.y(), out.segments[0].end.y()), 119.5, 4);
}

TEST(GuidedEdgesTest, WhereThereIsNoEdgeNoneIsFound) {
  EdgeImage out;
  GuidedEdges dut(Step(60, 0), 1, 0);
  EXPECT_FALSE(dut.Measure({40, 20}, {60, 220}, out));
  EXPECT_FALSE(dut.Measure(OnLine(20) + Eigen::Vector2d(9, 0), OnLine(220) + Eigen::Vector2d(9, 0), out));
  EXPECT_FALSE(dut.Measure({-500, -500}, {-400, -300}, out));
  EXPECT_FALSE(dut.Measure({100, 100}, {100, 100}, out));
  EXPECT_TRUE(out.segments.empty());
  EXPECT_TRUE(out.points.empty());
}

}  // namespace
}  // namespace priamos::head
