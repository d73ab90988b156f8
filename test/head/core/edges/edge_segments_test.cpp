#include "head/core/edges/edge_segments.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "common/geometry.hpp"
#include "test/support/line_scene.hpp"

namespace priamos::head {
namespace {

test::LineScore Score(double contrast, double noise, double blur_px) {
  Rng rng(11);
  test::LineScorer scorer;
  EdgeOperator dut;
  EdgeImage edges;
  for (int i = 0; i < 5; ++i) {
    const auto scene = test::RandomRectangles(contrast, noise, blur_px, rng);
    dut.Extract(scene.image, edges);
    scorer.Add(scene.lines, edges.segments);
  }
  return scorer.Score();
}

/// Bright right of a line through (x0, 100) that leans by `slope`, area sampled; rows begin to end.
cv::Mat StepImage(double x0, double slope, double dark = 60, double bright = 160) {
  cv::Mat image(200, 200, CV_8UC1);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      double cover = 0;
      for (int k = 0; k < 16; ++k) {
        const double edge = x0 + slope * (y + (k + 0.5) / 16 - 0.5 - 100);
        cover += std::clamp(x + 0.5 - edge, 0.0, 1.0) / 16;
      }
      image.at<unsigned char>(y, x) = cv::saturate_cast<unsigned char>(dark + cover * (bright - dark));
    }
  }
  return image;
}

TEST(EdgeOperatorTest, EndsLieOnTheTrueLineAtModerateNoise) {
  const auto score = Score(100, 5, 0.5);
  EXPECT_LE(score.mean_error_px, 0.025);
  EXPECT_GE(score.coverage, 0.98);
  EXPECT_LE(score.broken, 0.04);
  EXPECT_LE(score.pieces, 1.05);
  EXPECT_LE(score.n_false, 2);
}

TEST(EdgeOperatorTest, EndsLieOnTheTrueLineAtStrongNoise) {
  const auto score = Score(30, 10, 0.3);
  EXPECT_LE(score.mean_error_px, 0.12);
  EXPECT_GE(score.coverage, 0.98);
  EXPECT_LE(score.broken, 0.04);
  EXPECT_LE(score.n_false, 10);
}

TEST(EdgeOperatorTest, SigmaIsHonest) {
  EXPECT_NEAR(Score(100, 5, 0.5).nees, 1, 0.45);
  EXPECT_NEAR(Score(30, 10, 0.5).nees, 1, 0.45);
}

TEST(EdgeOperatorTest, HasNoShift) {
  // OpenCV's LSD, at its default scale, shifts every segment by an eighth of a pixel.
  EdgeOperator dut;
  EdgeImage edges;
  double sum = 0;
  constexpr int kN = 20;
  for (int i = 0; i < kN; ++i) {
    const double x0 = 90 + i / double(kN);
    dut.Extract(StepImage(x0, 0.13), edges);
    ASSERT_EQ(edges.segments.size(), 1u);
    const Eigen::Vector2d c = edges.segments[0].centre;
    sum += (c.x() - x0 - 0.13 * (c.y() - 100)) / kN;
  }
  EXPECT_NEAR(sum, 0, 0.002);
}

TEST(EdgeOperatorTest, BrightSideIsOnTheRightHand) {
  EdgeOperator dut;
  EdgeImage edges;
  cv::Mat image = StepImage(100.3, 0.05);
  for (int turn = 0; turn < 4; ++turn) {
    dut.Extract(image, edges);
    ASSERT_EQ(edges.segments.size(), 1u);
    const EdgeSegment& s = edges.segments[0];
    const Eigen::Vector2d middle = (s.begin + s.end) / 2;
    const Eigen::Vector2d bright = middle + 6 * s.normal(), dark = middle - 6 * s.normal();
    EXPECT_GT(image.at<unsigned char>(int(bright.y()), int(bright.x())),
              image.at<unsigned char>(int(dark.y()), int(dark.x())));
    cv::rotate(image, image, cv::ROTATE_90_CLOCKWISE);
  }
}

TEST(EdgeOperatorTest, ReportsTheGreyValuesOfBothSides) {
  EdgeOperator dut;
  EdgeImage edges;
  dut.Extract(StepImage(100.3, 0.05, 60, 160), edges);
  ASSERT_EQ(edges.segments.size(), 1u);
  EXPECT_NEAR(edges.segments[0].grey_left, 60, 1);
  EXPECT_NEAR(edges.segments[0].grey_right, 160, 1);
  EXPECT_NEAR(edges.segments[0].contrast(), 100, 2);
}

TEST(EdgeOperatorTest, PointsLieOnTheEdge) {
  EdgeOperator dut;
  EdgeImage edges;
  dut.Extract(StepImage(100.3, -0.2), edges);
  ASSERT_EQ(edges.segments.size(), 1u);
  EXPECT_GE(edges.segments[0].n_points, 15);
  for (const EdgePoint& p : edges.points) EXPECT_NEAR(p.at.x(), 100.3 - 0.2 * (p.at.y() - 100), 0.02);
}

TEST(EdgeOperatorTest, FindsNothingInPureNoise) {
  Rng rng(3);
  cv::Mat image(576, 768, CV_8UC1);
  for (int i = 0; i < 576 * 768; ++i) image.data[i] = cv::saturate_cast<unsigned char>(128 + rng.Normal(12));
  EdgeOperator dut;
  EdgeImage edges;
  dut.Extract(image, edges);
  EXPECT_LE(edges.segments.size(), 2u);
  EXPECT_NEAR(edges.noise_sigma, 12, 0.5);
}

TEST(EdgeOperatorTest, LeavesSoftShadowsOut) {
  cv::Mat image = StepImage(100, 0.1);
  cv::GaussianBlur(image, image, {}, 6);
  EdgeOperator dut;
  EdgeImage edges;
  dut.Extract(image, edges);
  EXPECT_TRUE(edges.segments.empty());
}

TEST(EdgeOperatorTest, TellsTwoNearEdgesApart) {
  // A dark stripe, 7 px wide.
  cv::Mat image(200, 200, CV_8UC1, cv::Scalar(180));
  image.colRange(90, 97).setTo(90);
  EdgeOperator dut;
  EdgeImage edges;
  dut.Extract(image, edges);
  ASSERT_EQ(edges.segments.size(), 2u);
  const double a = edges.segments[0].centre.x(), b = edges.segments[1].centre.x();
  EXPECT_NEAR(std::min(a, b), 89.5, 0.05);
  EXPECT_NEAR(std::max(a, b), 96.5, 0.05);
}

TEST(EdgeOperatorTest, IsTheSameForTheTransposedImage) {
  Rng rng(5);
  const auto scene = test::RandomRectangles(80, 3, 0.5, rng);
  cv::Mat transposed;
  cv::transpose(scene.image, transposed);
  EdgeOperator dut;
  EdgeImage a, b;
  dut.Extract(scene.image, a);
  dut.Extract(transposed, b);
  EXPECT_EQ(a.segments.size(), b.segments.size());
}

TEST(EdgeOperatorTest, ReportsBlackAndSaturatedImages) {
  EdgeOperator dut;
  EdgeImage edges;
  dut.Extract(cv::Mat(100, 100, CV_8UC1, cv::Scalar(0)), edges);
  EXPECT_EQ(edges.mean_grey, 0);
  EXPECT_EQ(edges.saturated_share, 1);
  EXPECT_TRUE(edges.segments.empty());
}

TEST(EdgeOperatorTest, RefusesWhatIsNoGreyImage) {
  EdgeOperator dut;
  EdgeImage edges;
  EXPECT_THROW(dut.Extract(cv::Mat(100, 100, CV_8UC3, cv::Scalar(0)), edges), std::invalid_argument);
  EXPECT_THROW(dut.Extract(cv::Mat(10, 100, CV_8UC1, cv::Scalar(0)), edges), std::invalid_argument);
  EXPECT_THROW(dut.Extract(cv::Mat(), edges), std::invalid_argument);
}

TEST(EdgeOperatorTest, SameImageSameBytes) {
  Rng rng(6);
  const auto scene = test::RandomRectangles(60, 6, 0.5, rng);
  EdgeOperator used, fresh;
  EdgeImage first, second;
  used.Extract(test::RandomRectangles(60, 6, 0.5, rng).image, first);
  used.Extract(scene.image, first);
  fresh.Extract(scene.image, second);
  ASSERT_EQ(first.segments.size(), second.segments.size());
  for (std::size_t i = 0; i < first.segments.size(); ++i)
    EXPECT_EQ(first.segments[i].begin, second.segments[i].begin);
}

std::size_t Found(const EdgeOperator::Options& options, double dark, double bright) {
  EdgeOperator dut(options);
  EdgeImage edges;
  dut.Extract(StepImage(100.3, 0.1, dark, bright), edges);
  return edges.segments.size();
}

TEST(EdgeOperatorTest, InADarkImageWeakerEdgesCount) {
  EdgeOperator::Options options;
  options.min_contrast = 8;
  EXPECT_EQ(Found(options, 20, 26), 0u);
  options.usual_grey = 80;
  EXPECT_EQ(Found(options, 20, 26), 1u) << "as an edge of 20 grey values under usual light";
  EXPECT_EQ(Found(options, 100, 106), 0u) << "a well exposed image";
  EXPECT_EQ(Found(options, 20, 22), 0u) << "never below 3 grey values";
}

}  // namespace
}  // namespace priamos::head
