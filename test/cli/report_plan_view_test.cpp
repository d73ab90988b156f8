#include "cli/report_plan_view.hpp"

#include <gtest/gtest.h>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

TEST(ReportPlanView, ExtentReachesToTheOuterFacesOfTheWalls) {
  const auto plan = LoadConfig<GroundPlan>(std::string(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml"));
  const Extent dut = ExtentOf(plan);
  EXPECT_NEAR((dut.low - Eigen::Vector2d(-0.14, -0.14)).norm(), 0, 1e-9);
  EXPECT_NEAR((dut.high - Eigen::Vector2d(10.14, 4.94)).norm(), 0, 1e-9);
}

TEST(ReportPlanView, PlanWithoutWallsHasAnExtent) {
  EXPECT_GT(ExtentOf(GroundPlan{}).size().minCoeff(), 0);
}

TEST(ReportPlanView, FootprintIsTurnedWithTheBase) {
  const auto dut = FootprintOutline({1, 2, kPi / 2});
  EXPECT_NEAR((dut[0] - Eigen::Vector2d(1 - 0.39, 2 + 0.475)).norm(), 0, 1e-9);
}

TEST(ReportPlanView, CovarianceIsThatOfThePosition) {
  pose_t pose{};
  pose.sigma_x_m = 0.2;
  pose.sigma_y_m = 0.1;
  pose.rho_x_y = 0.5;
  const Eigen::Matrix2d dut = CovarianceOf(pose);
  EXPECT_NEAR(dut(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(dut(0, 1), 0.01, 1e-12);
}

/// Pixels of a colour after `draw` had a clear view of 10 x 10 m.
template <class Draw>
int Painted(Colour colour, const Draw& draw) {
  Page page(400, 400, {0xffffff});
  View view(page, {0, 0, 400, 400}, {5, 5}, 40);
  draw(view);
  cv::Mat mask;
  const cv::Scalar bgr(colour.rgb & 0xff, colour.rgb >> 8 & 0xff, colour.rgb >> 16 & 0xff);
  cv::inRange(page.Finish(), bgr - cv::Scalar::all(16), bgr + cv::Scalar::all(16), mask);
  return cv::countNonZero(mask);
}

TEST(ReportPlanView, JumpOfTheBeliefIsAnArrowNotAPath) {
  const auto record_with_step = [](double step_m) {
    RunRecord record;
    for (int i = 0; i < 2; ++i) {
      pose_t pose{};
      pose.x_m = 5 + step_m * i;
      pose.y_m = 5;
      Feed(record, Side::kOnboard, i, "POSE", pose);
    }
    return record;
  };
  const auto painted = [&](Colour colour, double step_m) {
    return Painted(colour, [&](View& view) { DrawBelief(view, record_with_step(step_m), 3); });
  };
  EXPECT_GT(painted(colours::kFix, 1.0), 50);
  EXPECT_EQ(painted(colours::kBelief, 1.0), 0);
  EXPECT_EQ(painted(colours::kFix, 0.015), 0);
  EXPECT_GT(painted(colours::kBelief, 0.015), 0);
}

TEST(ReportPlanView, LooksWithoutTruthAreLeftOut) {
  RunRecord record = SyntheticRun{}.Record();
  const auto draw = [&](View& view) { DrawLooks(view, record, TestDoor()); };
  EXPECT_GT(Painted(colours::kFix, draw), 300);
  record.truth.clear();
  EXPECT_EQ(Painted(colours::kFix, draw), 0);
}

}  // namespace
}  // namespace priamos::cli
