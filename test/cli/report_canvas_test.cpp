#include "cli/report_canvas.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace priamos::cli {
namespace {

cv::Vec3b At(const cv::Mat& image, int x, int y) {
  return image.at<cv::Vec3b>(y, x);
}

TEST(ReportCanvas, MapPointsFallWhereTheScaleSays) {
  Page page(100, 60, {0xffffff});
  View dut(page, {20, 10, 60, 40}, {5, 5}, 10);
  dut.Dot({6, 6}, 3, {0xff0000});
  // Middle of the window (50, 30), 10 px right, 10 px up.
  EXPECT_EQ(At(page.Finish(), 60, 20), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(At(page.Finish(), 60, 40), cv::Vec3b(255, 255, 255));
}

TEST(ReportCanvas, ViewsClipAtTheirBorder) {
  Page page(100, 60, {0xffffff});
  View dut(page, {20, 10, 60, 40}, {0, 0}, 10);
  dut.Fill({{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, {0x000000});
  EXPECT_EQ(At(page.Finish(), 10, 30), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(At(page.Finish(), 30, 30), cv::Vec3b(0, 0, 0));
}

TEST(ReportCanvas, OpacityMixes) {
  Page page(100, 60, {0xffffff});
  View dut(page, {0, 0, 100, 60}, {0, 0}, 10);
  dut.Fill({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {0x000000}, 0.5);
  EXPECT_NEAR(At(page.Finish(), 50, 30)[0], 128, 2);
}

TEST(ReportCanvas, WiderTextIsWider) {
  const Page dut(100, 60, {0xffffff});
  EXPECT_GT(dut.TextWidth("two words", 12), dut.TextWidth("two", 12));
}

TEST(ReportCanvas, EllipseHoldsItsStandardDeviations) {
  Eigen::Matrix2d covariance;
  covariance << 0.04, 0.01, 0.01, 0.09;
  for (const auto& point : EllipseOutline({1, 2}, covariance, 2)) {
    const Eigen::Vector2d d = point - Eigen::Vector2d(1, 2);
    EXPECT_NEAR(std::sqrt(d.dot(covariance.inverse() * d)), 2, 1e-9);
  }
}

}  // namespace
}  // namespace priamos::cli
