#include "head/core/edges/equal_contrast.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

cv::Mat Half(double dark, double bright) {
  cv::Mat image(64, 64, CV_8UC1, cv::Scalar(dark));
  image.colRange(32, 64).setTo(cv::Scalar(bright));
  return image;
}

std::vector<double> WeakestOf(const std::vector<cv::Mat>& images, double usual) {
  EdgeOperator::Options options;
  options.min_contrast = usual;
  std::vector<double> weakest;
  for (const EdgeOperator::Options& of_one : ForOneScene(images, options))
    weakest.push_back(of_one.min_contrast);
  return weakest;
}

TEST(ForOneSceneTest, EqualImagesAreLookedAtAlike) {
  const std::vector<cv::Mat> images{Half(40, 200), Half(40, 200)};
  EXPECT_EQ(WeakestOf(images, 10), (std::vector<double>{10, 10}));
}

TEST(ForOneSceneTest, InAFlatterImageWeakerEdgesCount) {
  const std::vector<cv::Mat> images{Half(40, 200), Half(20, 100), Half(100, 228)};
  const auto dut = WeakestOf(images, 10);
  EXPECT_DOUBLE_EQ(dut[0], 10);
  EXPECT_DOUBLE_EQ(dut[1], 5);
  EXPECT_DOUBLE_EQ(dut[2], 8);
}

TEST(ForOneSceneTest, NoneIsWeakerThanGreyValuesTell) {
  const std::vector<cv::Mat> images{Half(0, 200), Half(10, 12), Half(77, 77)};
  const auto dut = WeakestOf(images, 10);
  EXPECT_DOUBLE_EQ(dut[1], 3);
  EXPECT_DOUBLE_EQ(dut[2], 3);
  EXPECT_DOUBLE_EQ(WeakestOf(images, 2)[2], 2) << "asked for weaker ones than that";
}

TEST(ForOneSceneTest, WithoutAnyContrastNothingChanges) {
  const std::vector<cv::Mat> images{Half(9, 9), Half(0, 0)};
  EXPECT_EQ(WeakestOf(images, 10), (std::vector<double>{10, 10}));
  EXPECT_TRUE(WeakestOf({}, 10).empty());
}

TEST(ForOneSceneTest, ADarkImageShowsTheEdgesOfTheBrightOne) {
  cv::Mat bright(128, 128, CV_8UC1, cv::Scalar(20));
  bright.colRange(80, 128).setTo(cv::Scalar(230));
  bright({20, 30, 40, 60}).setTo(cv::Scalar(41));
  cv::GaussianBlur(bright, bright, {}, 0.8);
  const std::vector<cv::Mat> images{bright, bright * 0.5};
  const auto options = ForOneScene(images, {});
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < 2; ++i) {
    EdgeImage edges;
    EdgeOperator(options[i]).Extract(images[i], edges);
    counts.push_back(edges.segments.size());
  }
  EdgeImage as_usual;
  EdgeOperator().Extract(images[1], as_usual);
  EXPECT_LT(as_usual.segments.size(), counts[0]);
  EXPECT_EQ(counts[0], 5u);
  EXPECT_EQ(counts[1], counts[0]);
}

}  // namespace
}  // namespace priamos::head
