#include "head/core/edges/edge_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace priamos::head {
namespace {

constexpr double kNoiseSigma = 4;

/// Dark left of column `at` + `slope` * (row - 100), bright right of it, blurred.
cv::Mat Edge(double at, double slope) {
  cv::Mat image(200, 200, CV_8UC1);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double beside = x - at - slope * (y - 100);
      image.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround(110 + 50 * std::erf(beside / std::sqrt(2 * 0.49))));
    }
  }
  return image;
}

AxisLine Line(double at, double slope) {
  AxisLine line;
  line.origin = 100;
  line.offset = at;
  line.slope = slope;
  line.ChooseKernels();
  return line;
}

class EdgeFitterTest : public testing::Test {
 protected:
  void Load(const cv::Mat& image, const AxisLine& line, int first = 60, int last = 140) {
    blocks.SetImage(image);
    blocks.ChooseSize(last - first);
    blocks.Measure(line, first, last);
    dut.Load(blocks, line, kNoiseSigma);
  }
  EdgeBlocks blocks;
  EdgeFitter dut;
  EdgeOffset fit;
};

TEST_F(EdgeFitterTest, FindsTheEdgeBesideTheLine) {
  const struct {
    KernelWidth width;
    double farthest;
  } cases[] = {{KernelWidth::kWide, 0.65}, {KernelWidth::kNarrow, 0.35}};
  for (const auto& c : cases) {
    for (const double offset : {-c.farthest, 0.0, 0.2}) {
      for (const double turn : {-0.004, 0.0, 0.004}) {
        Load(Edge(90.2 + offset, 0.2 + turn), Line(90.2, 0.2));
        ASSERT_TRUE(dut.Solve(c.width, 3, fit));
        EXPECT_NEAR(fit.offset + fit.slope * (100 - fit.centroid), offset, 0.01);
        EXPECT_NEAR(fit.slope, turn, 4e-4);
      }
    }
  }
}

TEST_F(EdgeFitterTest, BlocksThatDisagreeLoseWeight) {
  const AxisLine line = Line(90.2, 0.2);
  cv::Mat image = Edge(90.2, 0.2);
  image.rowRange(80, 88).colRange(80, 87).setTo(90);  // something else that touches the edge
  Load(image, line);
  ASSERT_TRUE(dut.Solve(KernelWidth::kWide, 1, fit));
  const double credulous = std::abs(fit.offset);
  ASSERT_TRUE(dut.Solve(KernelWidth::kWide, 3, fit));
  EXPECT_LT(std::abs(fit.offset), 0.5 * credulous);
}

TEST_F(EdgeFitterTest, VarianceIsThatOfTheErrors) {
  const AxisLine line = Line(90.2, 0.2);
  const cv::Mat image = Edge(90.2, 0.2);
  cv::RNG random(7);
  double offset = 0, slope = 0;
  constexpr int kTrials = 400;
  for (int i = 0; i < kTrials; ++i) {
    cv::Mat noisy, added(image.size(), CV_16SC1);
    random.fill(added, cv::RNG::NORMAL, 0, kNoiseSigma);
    cv::add(image, added, noisy, cv::noArray(), CV_8UC1);
    Load(noisy, line);
    ASSERT_TRUE(dut.Solve(KernelWidth::kWide, 3, fit));
    dut.AddVariance(fit);
    offset += fit.offset * fit.offset / fit.variance_offset / kTrials;
    slope += fit.slope * fit.slope / fit.variance_slope / kTrials;
  }
  EXPECT_NEAR(offset, 1, 0.3);
  EXPECT_NEAR(slope, 1, 0.3);
}

TEST_F(EdgeFitterTest, TwoBlocksTellNothing) {
  const AxisLine line = Line(90.2, 0.2);
  Load(Edge(90.2, 0.2), line, 100, 105);
  EXPECT_FALSE(dut.Solve(KernelWidth::kWide, 1, fit));
}

}  // namespace
}  // namespace priamos::head
