#include "cli/report/report_corridor.hpp"

#include <gtest/gtest.h>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

/// A drive of 10 m along y = x, believed 3 cm to its left and 5 cm behind.
RunRecord Drive(std::int8_t mission) {
  RunRecord record;
  mission_command_t order{};
  order.utime = 1'000'000;
  order.mission = mission;
  record.orders.push_back(order);
  const Pose2 start{2, 1, kPi / 4};
  for (int i = 0; i <= 400; ++i) {
    const Pose2 at = start * Pose2{i * 0.025, 0, 0};
    world_truth_t truth{};
    truth.utime = 1'000'000 + i * 20'000;
    truth.x_m = at.x;
    truth.y_m = at.y;
    truth.yaw_rad = at.yaw;
    record.truth.push_back(truth);
    const Pose2 believed = at * Pose2{-0.05, 0.03, 0.01};
    pose_t pose{};
    pose.utime = truth.utime;
    pose.x_m = believed.x;
    pose.y_m = believed.y;
    pose.yaw_rad = believed.yaw;
    pose.sigma_x_m = pose.sigma_y_m = 0.05;
    pose.sigma_yaw_rad = 0.01;
    record.poses.push_back(pose);
  }
  mission_status_t status{};
  status.utime = record.truth.back().utime;
  status.phase = mission_status_t::DONE;
  record.mission.push_back(status);
  return record;
}

TEST(ReportCorridor, ErrorsCountAcrossTheDriveAndAlongIt) {
  const auto dut = CorridorSummaryOf(Drive(mission_command_t::CORRIDOR));
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->driven_m, 10, 1e-6);
  EXPECT_NEAR(dut->across_rms_m, 0.03, 1e-6);
  ASSERT_TRUE(dut->end);
  EXPECT_NEAR(dut->end->lateral_m, 0.03, 1e-6);
  EXPECT_NEAR(dut->end->along_m, -0.05, 1e-6);
  EXPECT_NEAR(dut->end->nees, 0.36 + 1 + 1, 1e-6);
}

TEST(ReportCorridor, OtherDrivesHaveNone) {
  EXPECT_FALSE(CorridorSummaryOf(Drive(mission_command_t::GOTO)));
  EXPECT_FALSE(CorridorSummaryOf(RunRecord{}));
}

}  // namespace
}  // namespace priamos::cli
