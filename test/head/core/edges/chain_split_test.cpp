#include "head/core/edges/chain_split.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "common/geometry.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using support::Between;

/// Gradients that say nothing about where between the pixels an edge lies.
GradientMap Flat() {
  GradientMap map;
  map.Compute(cv::Mat(200, 200, CV_8UC1, cv::Scalar(90)));
  return map;
}

/// Chains drawn pixel by pixel.
class Pencil {
 public:
  Pencil& At(int x, int y) {
    chains_.pixels.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    return *this;
  }
  /// `n` pixels after the last one.
  Pencil& Go(int n, int dx, int dy) {
    for (int i = 0; i < n; ++i) At(chains_.pixels.back().x + dx, chains_.pixels.back().y + dy);
    return *this;
  }
  Pencil& Up() {
    chains_.begins.push_back(static_cast<int>(chains_.pixels.size()));
    return *this;
  }
  std::vector<RoughLine> Split(const ChainSplitter::Options& options = {}) const {
    std::vector<RoughLine> lines{RoughLine{}};  // which the splitter has to forget
    ChainSplitter().Split(Flat(), chains_, options, lines);
    return lines;
  }

 private:
  EdgeChains chains_{{}, {0}};
};

void ExpectLine(const RoughLine& line, double x1, double y1, double x2, double y2, double tolerance) {
  EXPECT_NEAR(line.x1, x1, tolerance);
  EXPECT_NEAR(line.y1, y1, tolerance);
  EXPECT_NEAR(line.x2, x2, tolerance);
  EXPECT_NEAR(line.y2, y2, tolerance);
}

TEST(ChainSplitterTest, AStraightChainIsOneLineFromItsFirstToItsLastPixel) {
  const struct {
    int dx, dy;
  } steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
  for (const auto& s : steps) {
    const auto lines = Pencil().At(100, 100).Go(40, s.dx, s.dy).Up().Split();
    ASSERT_EQ(lines.size(), 1u) << s.dx << ' ' << s.dy;
    ExpectLine(lines[0], 100, 100, 100 + 40 * s.dx, 100 + 40 * s.dy, 1e-3);
  }
}

RC_GTEST_PROP(ChainSplitterTest, ALineOfAnySlopeIsFoundToPixelAccuracy, ()) {
  const double angle = Between(-kPi, kPi), length = Between(15, 80);
  const double ux = std::cos(angle), uy = std::sin(angle), step = std::max(std::abs(ux), std::abs(uy));
  Pencil pencil;
  int n = 0;
  for (; n <= length * step; ++n)
    pencil.At(int(std::lround(100 + n * ux / step)), int(std::lround(100 + n * uy / step)));
  const auto lines = pencil.Up().Split();
  RC_ASSERT(lines.size() == 1u);
  const double x2 = 100 + (n - 1) * ux / step, y2 = 100 + (n - 1) * uy / step;
  // Half a pixel across by rounding, and one step along: a last pixel to the side ends a line.
  const double most = std::hypot(1 / step, 0.5) + 1e-6;
  RC_ASSERT(std::hypot(lines[0].x1 - 100, lines[0].y1 - 100) < most);
  RC_ASSERT(std::hypot(lines[0].x2 - x2, lines[0].y2 - y2) < most);
}

TEST(ChainSplitterTest, ACornerEndsALineAndTheNextOneBegins) {
  const auto lines = Pencil().At(50, 50).Go(30, 1, 0).Go(30, 0, 1).Up().Split();
  ASSERT_EQ(lines.size(), 2u);
  ExpectLine(lines[0], 50, 50, 80, 50, 1.5);
  ExpectLine(lines[1], 80, 50, 80, 80, 2);
}

TEST(ChainSplitterTest, NoLineIsShorterThanTheLeastNumberOfPixels) {
  EXPECT_TRUE(Pencil().At(50, 50).Go(8, 1, 0).Up().Split().empty());
  EXPECT_EQ(Pencil().At(50, 50).Go(9, 1, 0).Up().Split().size(), 1u);
  EXPECT_EQ(Pencil().At(50, 50).Go(8, 1, 0).Up().Split({.min_pixels = 9}).size(), 1u);
}

TEST(ChainSplitterTest, ALineBeginsOnlyWherePixelsLieOnOne) {
  Pencil zigzag;
  for (int i = 0; i < 20; ++i) zigzag.At(50 + i, 50 + (i % 2) * 2);  // RMS about 1 px
  EXPECT_TRUE(zigzag.Up().Split().empty());
  EXPECT_EQ(zigzag.Split({.begin_rms_px = 1.1}).size(), 1u);
}

TEST(ChainSplitterTest, ABadBeginningDoesNotLoseTheRest) {
  Pencil pencil;
  for (int i = 0; i < 6; ++i) pencil.At(50 + i, 50 + (i % 2) * 8);
  const auto lines = pencil.At(56, 50).Go(40, 1, 0).Up().Split();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_LT(lines[0].x1, 60);
  EXPECT_NEAR(lines[0].x2, 96, 1e-3);
}

/// 20 pixels in a row, `n` that lie `beside`, 30 more in the row.
Pencil Interrupted(int n, int beside) {
  Pencil pencil;
  pencil.At(50, 50).Go(19, 1, 0);
  for (int i = 0; i < n; ++i) pencil.At(70 + i, 50 + beside);
  return pencil.At(70 + n, 50).Go(29, 1, 0).Up();
}

TEST(ChainSplitterTest, AFewStraysDoNotEndALine) {
  const auto whole = Interrupted(3, 5).Split();
  ASSERT_EQ(whole.size(), 1u);
  ExpectLine(whole[0], 50, 50, 102, 50, 0.01);
  const auto broken = Interrupted(4, 5).Split();
  ASSERT_EQ(broken.size(), 2u);
  ExpectLine(broken[0], 50, 50, 69, 50, 0.01);
  EXPECT_NEAR(broken[1].x2, 103, 0.01);
  EXPECT_EQ(Interrupted(4, 5).Split({.max_strays = 5}).size(), 1u);
}

TEST(ChainSplitterTest, OnlyStraysInARowEndALine) {
  Pencil pencil;
  pencil.At(50, 50).Go(19, 1, 0);
  for (int x = 70; x < 94; x += 8) pencil.At(x, 56).At(x + 1, 56).At(x + 2, 56).At(x + 3, 50).Go(4, 1, 0);
  const auto lines = pencil.Up().Split();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].x2, 93, 0.01);
}

TEST(ChainSplitterTest, HowFarAPixelMayLieBesideTheLine) {
  // A chain that steps aside for good: near enough it is the same line, else it ends there.
  const auto stepped = [](int beside) {
    return Pencil().At(50, 50).Go(40, 1, 0).At(91, 50 + beside).Go(9, 1, 0).Up();
  };
  EXPECT_NEAR(stepped(1).Split().front().x2, 100, 0.1);
  EXPECT_NEAR(stepped(2).Split().front().x2, 90, 0.1);
  EXPECT_NEAR(stepped(2).Split({.max_distance_px = 2.5}).front().x2, 100, 0.1);
}

TEST(ChainSplitterTest, EveryChainIsSplitByItself) {
  const auto lines = Pencil()
                         .At(10, 20)
                         .Go(30, 1, 0)
                         .Up()
                         .Up()
                         .At(41, 20)
                         .Go(30, 1, 0)
                         .Up()
                         .At(100, 20)
                         .Go(30, 0, 1)
                         .Up()
                         .Split();
  ASSERT_EQ(lines.size(), 3u);
  ExpectLine(lines[0], 10, 20, 40, 20, 1e-3);
  ExpectLine(lines[1], 41, 20, 71, 20, 1e-3);
  ExpectLine(lines[2], 100, 20, 100, 50, 1e-3);
}

TEST(ChainSplitterTest, NoChainsNoLines) {
  EXPECT_TRUE(Pencil().Split().empty());
  std::vector<RoughLine> lines{RoughLine{}};
  ChainSplitter().Split(Flat(), {}, {}, lines);
  EXPECT_TRUE(lines.empty());
}

/// Bright right of `at` + `slope` * y, blurred as a lens does.
cv::Mat SlantedStep(double at, double slope) {
  cv::Mat image(100, 100, CV_8UC1);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x)
      image.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround(110 + 50 * std::erf((x - at - slope * y) / 1.2)));
  return image;
}

TEST(ChainSplitterTest, GradientsBesideTheChainTellWhereBetweenThePixelsTheEdgeLies) {
  for (const double at : {40.0, 40.25, 40.5, 40.75}) {
    GradientMap gradients;
    gradients.Compute(SlantedStep(at, 0));
    EdgeChains chains;
    ChainTracer().Trace(gradients, {}, chains);
    std::vector<RoughLine> lines;
    ChainSplitter().Split(gradients, chains, {}, lines);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0].x1, at, 0.1);
    EXPECT_NEAR(lines[0].x2, at, 0.1);
  }
}

}  // namespace
}  // namespace priamos::head
