#include "head/core/stereo/pair_order.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "head/core/edges/edge_segments.hpp"

namespace priamos::head {
namespace {

constexpr double kFocal_px = 400, kBaseline_m = 0.15;

CameraModel Camera(double right_m) {
  CameraModel camera;
  camera.image_from_base << kFocal_px, 0, 160, -kFocal_px * right_m, 0, kFocal_px, 120, 0, 0, 0, 1, 0;
  camera.centre_px = {159.5, 119.5};
  return camera;
}

/// Boards at several distances, as the camera `right_m` beside the left one sees them; all moved by
/// `shift_px`.
EdgeImage Boards(double right_m, double shift_px = 0) {
  constexpr int kFine = 16;  // drawn with 1/16 px
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(60));
  int i = 0;
  for (const double depth_m : {4.0, 3.0, 2.2, 1.6, 1.2}) {
    const double left = 30 + 55 * i - kFocal_px * right_m / depth_m + shift_px, top = 30 + 20 * i;
    const cv::Point from(static_cast<int>(kFine * left), static_cast<int>(kFine * top));
    cv::rectangle(image, from, from + cv::Point(kFine * 32, kFine * 60), cv::Scalar(120 + 25 * i), cv::FILLED,
                  cv::LINE_AA, 4);
    ++i;
  }
  cv::GaussianBlur(image, image, {}, 0.8);
  EdgeImage edges;
  EdgeOperator().Extract(image, edges);
  return edges;
}

PairOrder Judge(const EdgeImage& first, const EdgeImage& second) {
  const CameraModel left = Camera(0), right = Camera(kBaseline_m);
  return JudgeOrder(MakeView(left, first), MakeView(right, second), {});
}

TEST(JudgeOrder, ARightPairIsAccepted) {
  const PairOrder dut = Judge(Boards(0), Boards(kBaseline_m));
  EXPECT_EQ(dut.verdict, PairVerdict::kRight);
  EXPECT_GE(dut.n_as_given, 6);
  EXPECT_GT(dut.as_given, 2 * dut.exchanged);
  EXPECT_GE(dut.n_should_move, 6);
}

TEST(JudgeOrder, AnExchangedPairIsNoticed) {
  const PairOrder dut = Judge(Boards(kBaseline_m), Boards(0));
  EXPECT_EQ(dut.verdict, PairVerdict::kExchanged);
  EXPECT_GE(dut.n_exchanged, 6);
}

TEST(JudgeOrder, OneImageTwiceIsNoticedAlsoWhenItWasMoved) {
  for (const double shift_px : {0.0, 1.0, -1.0, 1.5}) {
    const PairOrder dut = Judge(Boards(0), Boards(0, shift_px));
    EXPECT_EQ(dut.verdict, PairVerdict::kSameView) << shift_px;
    EXPECT_GE(dut.n_still, 6) << shift_px;
  }
}

TEST(JudgeOrder, ImagesWithoutEdgesTellNothing) {
  EXPECT_EQ(Judge({320, 240, 0, 0, 0, {}, {}}, {320, 240, 0, 0, 0, {}, {}}).verdict, PairVerdict::kUnknown);
}

}  // namespace
}  // namespace priamos::head
