#include "cli/report_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

const GroundPlan& Plan() {
  static const auto plan =
      LoadConfig<GroundPlan>(std::string(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml"));
  return plan;
}

cv::Mat Drawn(const RunRecord& record) {
  return DrawRun(record, Summarise(record, TestInfo()), TestInfo(), Plan());
}

/// Pixels within `tolerance` of a colour, 0xRRGGBB.
int Count(const cv::Mat& image, unsigned rgb, const cv::Rect& where, int tolerance = 24) {
  const cv::Scalar colour(rgb & 0xff, rgb >> 8 & 0xff, rgb >> 16 & 0xff);
  cv::Mat mask;
  cv::inRange(image(where), colour - cv::Scalar::all(tolerance), colour + cv::Scalar::all(tolerance), mask);
  return cv::countNonZero(mask);
}

// The plan fills the page's width below the header.
const cv::Rect kPlanWindow{36, 84, 1528, 752};
constexpr unsigned kTruth = 0x1f62c4, kBelief = 0xe8741c, kFix = 0x12915a, kWall = 0x3b4550, kBad = 0xc0322b;

TEST(ReportPicture, HasTheDocumentedSize) {
  const cv::Mat dut = Drawn(SyntheticRun{}.Record());
  EXPECT_EQ(dut.cols, 1600);
  EXPECT_EQ(dut.rows, 1236);
  EXPECT_EQ(dut.type(), CV_8UC3);
}

TEST(ReportPicture, PathsAndFixesAreInThePlan) {
  const cv::Mat dut = Drawn(SyntheticRun{}.Record());
  EXPECT_GT(Count(dut, kTruth, kPlanWindow), 1000);
  EXPECT_GT(Count(dut, kBelief, kPlanWindow), 1000);
  EXPECT_GT(Count(dut, kFix, kPlanWindow), 500);
}

TEST(ReportPicture, EmptyRecordGivesThePlanAlone) {
  const cv::Mat dut = Drawn(RunRecord{});
  EXPECT_GT(Count(dut, kWall, kPlanWindow), 20000);
  EXPECT_EQ(Count(dut, kTruth, kPlanWindow), 0);
  EXPECT_EQ(Count(dut, kBelief, kPlanWindow), 0);
}

TEST(ReportPicture, FailureIsRed) {
  const cv::Rect header{900, 0, 700, 80};
  EXPECT_EQ(Count(Drawn(SyntheticRun{}.Record()), kBad, header), 0);
  EXPECT_GT(Count(Drawn(SyntheticRun{.done = false}.Record()), kBad, header), 2000);
  EXPECT_GT(Count(Drawn(SyntheticRun{.contacts = 1}.Record()), kBad, header), 2000);
}

TEST(ReportPicture, TruePathIsWhereTheRobotWas) {
  RunRecord record;
  for (int i = 0; i < 100; ++i) {
    world_truth_t truth{};
    truth.x_m = 2 + 0.02 * i;
    truth.y_m = 1.2;
    Feed(record, Side::kOnboard, 0.02 * i, "WORLD_TRUTH", truth);
  }
  const cv::Mat dut = Drawn(record);
  // 10.28 m of plan in 1528 pixels: half way along the path.
  const double scale = 1528 / 10.28;
  const int x = static_cast<int>(36 + (3.0 + 0.14) * scale),
            y = static_cast<int>(kPlanWindow.y + 376 - (1.2 - 2.4) * scale);
  EXPECT_GT(Count(dut, kTruth, {x - 4, y - 8, 8, 16}), 8);
}

TEST(ReportPicture, PositionsBeyondThePlanDoNoHarm) {
  RunRecord record;
  for (int i = 0; i < 3; ++i) {
    world_truth_t truth{};
    truth.x_m = 1e300 * (i - 1);
    truth.y_m = -1e12;
    Feed(record, Side::kOnboard, i, "WORLD_TRUTH", truth);
    pose_t pose{};
    pose.x_m = -1e200 * i;
    pose.sigma_x_m = 1e100;
    Feed(record, Side::kOnboard, i, "POSE", pose);
  }
  EXPECT_EQ(Drawn(record).cols, 1600);
}

}  // namespace
}  // namespace priamos::cli
