#include "head/core/edges/edge_refit.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

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

}  // namespace
}  // namespace priamos::head
