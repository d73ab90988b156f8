#include "head/core/edges/edge_blocks.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace priamos::head {
namespace {

/// Bright right of column 100, from row `top` to row `bottom`.
cv::Mat Step(cv::Size size, int top, int bottom) {
  cv::Mat image(size, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(100, top, size.width - 100, bottom - top + 1)).setTo(160);
  return image;
}

AxisLine Upright(double across) {
  AxisLine line;
  line.offset = across;
  line.ChooseKernels();
  return line;
}

class EdgeBlocksTest : public testing::Test {
 protected:
  void Measure(const cv::Mat& image, int first, int last) {
    dut.SetImage(image);
    dut.ChooseSize(last - first);
    dut.Measure(Upright(99.5), first, last);
  }
  EdgeBlocks dut;
};

TEST_F(EdgeBlocksTest, AnEdgeIsFollowedToWhereItEnds) {
  Measure(Step({200, 200}, 41, 158), 90, 120);
  ASSERT_TRUE(dut.FindEnds(Upright(99.5)));
  EXPECT_NEAR(dut.first(), 40.5, 0.1);
  EXPECT_NEAR(dut.last(), 158.5, 0.1);
}

TEST_F(EdgeBlocksTest, RowsBeyondTheEndOfAnEdgeAreDropped) {
  Measure(Step({200, 200}, 41, 158), 20, 180);
  ASSERT_TRUE(dut.FindEnds(Upright(99.5)));
  EXPECT_NEAR(dut.first(), 40.5, 0.1);
  EXPECT_NEAR(dut.last(), 158.5, 0.1);
}

TEST_F(EdgeBlocksTest, NoRowIsMeasuredTwiceAndTheImageHasAnEnd) {
  for (const int first : {5, 6, 7, 8}) {
    Measure(Step({200, 200}, 0, 199), first, first + 30);
    ASSERT_TRUE(dut.FindEnds(Upright(99.5)));
    EXPECT_FLOAT_EQ(dut.total().rows, 200);
    EXPECT_NEAR(dut.first(), -0.5, 1e-4);
    EXPECT_NEAR(dut.last(), 199.5, 1e-4);
    for (std::size_t i = 1; i < dut.all().size(); ++i) EXPECT_GT(dut.all()[i].along, dut.all()[i - 1].along);
  }
}

TEST_F(EdgeBlocksTest, ShortBlocksOnALongEdgeHaveABound) {
  Measure(Step({120, 16000}, 0, 15999), 8000, 8010);
  ASSERT_TRUE(dut.FindEnds(Upright(99.5)));
  EXPECT_EQ(dut.all().size(), EdgeBlocks::kMaxBlocks);
  dut.Measure(Upright(99.5), 0, 15999);
  EXPECT_EQ(dut.all().size(), EdgeBlocks::kMaxBlocks);
}

TEST_F(EdgeBlocksTest, WhereNothingIsThereIsNoEdge) {
  Measure(cv::Mat(200, 200, CV_8UC1, cv::Scalar(90)), 20, 60);
  EXPECT_FALSE(dut.FindEnds(Upright(99.5)));
  EXPECT_TRUE(dut.all().empty());
}

}  // namespace
}  // namespace priamos::head
