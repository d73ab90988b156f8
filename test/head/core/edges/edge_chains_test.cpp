#include "head/core/edges/edge_chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>
#include <span>
#include <utility>

#include "common/geometry.hpp"
#include "common/random.hpp"

namespace priamos::head {
namespace {

constexpr int kSize = 100;

/// Bright where `normal`.dot(pixel - middle) is positive, with a soft step as a lens makes it.
cv::Mat Step(double angle_rad, int dark = 60, int bright = 160) {
  cv::Mat image(kSize, kSize, CV_8UC1);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double beside = std::cos(angle_rad) * (x - 50.3) + std::sin(angle_rad) * (y - 49.8);
      const double share = std::clamp(beside + 0.5, 0.0, 1.0);
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::lround(dark + share * (bright - dark)));
    }
  }
  return image;
}

class ChainTracerTest : public testing::Test {
 protected:
  void Trace(const cv::Mat& image) {
    gradients.Compute(image);
    dut.Trace(gradients, options, chains);
  }
  std::span<const ChainPixel> Chain(int i) const {
    return std::span(chains.pixels).subspan(chains.begins[i], chains.begins[i + 1] - chains.begins[i]);
  }
  std::span<const ChainPixel> Longest() const {
    std::span<const ChainPixel> longest;
    for (int i = 0; i < chains.size(); ++i)
      if (Chain(i).size() > longest.size()) longest = Chain(i);
    return longest;
  }

  GradientMap gradients;
  ChainTracer dut;
  ChainTracer::Options options;
  EdgeChains chains;
};

TEST_F(ChainTracerTest, AStepInAnyDirectionIsOneChainAlongIt) {
  for (double degrees = 0; degrees < 360; degrees += 15) {
    const double angle = Radians(degrees);
    Trace(Step(angle));
    ASSERT_EQ(chains.size(), 1) << degrees;
    for (const ChainPixel p : Chain(0)) {
      const double beside = std::cos(angle) * (p.x - 50.3) + std::sin(angle) * (p.y - 49.8);
      EXPECT_LT(std::abs(beside), 1.2) << degrees << ' ' << p.x << ' ' << p.y;
    }
    EXPECT_GT(Chain(0).size(), 90u) << degrees;
  }
}

TEST_F(ChainTracerTest, ChainsRunWithTheBrightSideOnTheRightHand) {
  for (double degrees = 0; degrees < 360; degrees += 15) {
    Trace(Step(Radians(degrees)));
    ASSERT_EQ(chains.size(), 1) << degrees;
    const ChainPixel first = Chain(0).front(), last = Chain(0).back();
    // The right hand of who goes (dx, dy) in a picture with y down is (-dy, dx).
    const double right_x = first.y - last.y, right_y = last.x - first.x;
    EXPECT_GT(right_x * std::cos(Radians(degrees)) + right_y * std::sin(Radians(degrees)), 80) << degrees;
  }
}

TEST_F(ChainTracerTest, PixelsOfAChainAreNeighbours) {
  for (double degrees = 0; degrees < 180; degrees += 10) {
    Trace(Step(Radians(degrees)));
    for (int c = 0; c < chains.size(); ++c) {
      for (std::size_t i = 1; i < Chain(c).size(); ++i) {
        const int dx = Chain(c)[i].x - Chain(c)[i - 1].x, dy = Chain(c)[i].y - Chain(c)[i - 1].y;
        EXPECT_EQ(std::max(std::abs(dx), std::abs(dy)), 1) << degrees;
      }
    }
  }
}

TEST_F(ChainTracerTest, NoPixelIsInTwoChainsOrOnTheBorder) {
  Rng rng(1);
  cv::Mat image(70, 90, CV_8UC1);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(rng.Below(256));
  options.min_pixels = 3;
  Trace(image);
  ASSERT_GT(chains.size(), 20);
  std::set<std::pair<int, int>> seen;
  for (const ChainPixel p : chains.pixels) {
    EXPECT_TRUE(seen.emplace(p.x, p.y).second) << p.x << ' ' << p.y;
    EXPECT_TRUE(p.x > 0 && p.y > 0 && p.x < 89 && p.y < 69) << p.x << ' ' << p.y;
    EXPECT_GT(gradients.magnitude(p.y)[p.x], options.link_threshold);
  }
}

TEST_F(ChainTracerTest, TheChainsFillTheListOfPixels) {
  cv::Mat image(kSize, kSize, CV_8UC1, cv::Scalar(60));
  image(cv::Rect(20, 20, 30, 60)).setTo(160);
  image(cv::Rect(65, 30, 20, 20)).setTo(20);
  Trace(image);
  ASSERT_GT(chains.size(), 1);
  EXPECT_EQ(chains.begins.front(), 0);
  EXPECT_EQ(chains.begins.back(), int(chains.pixels.size()));
  for (int i = 0; i < chains.size(); ++i) EXPECT_GE(int(Chain(i).size()), options.min_pixels);
}

TEST_F(ChainTracerTest, ShortChainsAreDropped) {
  Trace(Step(0.4));
  ASSERT_EQ(chains.size(), 1);
  options.min_pixels = static_cast<int>(Chain(0).size());
  Trace(Step(0.4));
  EXPECT_EQ(chains.size(), 1);
  ++options.min_pixels;
  Trace(Step(0.4));
  EXPECT_EQ(chains.size(), 0);
  EXPECT_TRUE(chains.pixels.empty());
}

TEST_F(ChainTracerTest, AChainBeginsWhereTheEdgeIsStrongEnough) {
  gradients.Compute(Step(0, 100, 110));
  const int peak = *std::max_element(gradients.magnitude(50), gradients.magnitude(50) + kSize);
  options.link_threshold = peak / 2.0;
  options.seed_threshold = peak;
  dut.Trace(gradients, options, chains);
  EXPECT_EQ(chains.size(), 1) << "at the threshold is enough";
  options.seed_threshold = peak + 1;
  dut.Trace(gradients, options, chains);
  EXPECT_EQ(chains.size(), 0);
}

TEST_F(ChainTracerTest, AChainGoesOnWhereNoneWouldBegin) {
  cv::Mat image(kSize, kSize, CV_8UC1);  // an edge that fades from the top to the bottom
  for (int y = 0; y < kSize; ++y) Step(0, 100, 150 - y / 2).row(y).copyTo(image.row(y));
  gradients.Compute(image);
  options.seed_threshold = gradients.magnitude(20)[50];
  for (const int row : {40, 60, 80}) {
    options.link_threshold = gradients.magnitude(row)[50];
    dut.Trace(gradients, options, chains);
    int lowest = 0;
    for (const ChainPixel p : Longest()) lowest = std::max<int>(lowest, p.y);
    EXPECT_NEAR(lowest, row, 4);
  }
}

TEST_F(ChainTracerTest, AChainNeverChangesTheSignOfItsContrast) {
  cv::Mat image = Step(0, 60, 160);
  Step(0, 160, 60).rowRange(50, kSize).copyTo(image.rowRange(50, kSize));
  Trace(image);
  int steep = 0;
  for (int c = 0; c < chains.size(); ++c) {
    const auto [top, bottom] =
        std::minmax(Chain(c).front(), Chain(c).back(), [](auto a, auto b) { return a.y < b.y; });
    if (bottom.y - top.y < 20) continue;
    ++steep;
    EXPECT_TRUE(bottom.y < 54 || top.y > 46) << top.y << " to " << bottom.y;
    const bool goes_up = Chain(c).front().y > Chain(c).back().y;
    EXPECT_EQ(goes_up, top.y < 40) << "up where it is bright on the right, else down";
  }
  EXPECT_EQ(steep, 2);
}

TEST_F(ChainTracerTest, WhatWasTracedBeforeIsForgotten) {
  Trace(Step(0.3));
  const cv::Mat small = Step(1.2)(cv::Rect(20, 20, 60, 50)).clone();
  Trace(small);
  ChainTracer fresh;
  EdgeChains expected;
  fresh.Trace(gradients, options, expected);
  EXPECT_EQ(chains.begins, expected.begins);
  ASSERT_EQ(chains.pixels.size(), expected.pixels.size());
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    EXPECT_TRUE(chains.pixels[i].x == expected.pixels[i].x && chains.pixels[i].y == expected.pixels[i].y);
}

TEST_F(ChainTracerTest, AFlatPictureHasNoChains) {
  EXPECT_EQ(EdgeChains{}.size(), 0);
  Trace(cv::Mat(40, 40, CV_8UC1, cv::Scalar(90)));
  EXPECT_EQ(chains.size(), 0);
  EXPECT_TRUE(chains.pixels.empty());
}

}  // namespace
}  // namespace priamos::head
