#include "cli/report/report_explore.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

world::Solid Box(double x_m, double y_m, double length_m, double width_m) {
  world::Solid solid;
  solid.map_from_solid = {x_m, y_m, 0};
  solid.size_m = {length_m, width_m};
  solid.z_max_m = 2.5;
  return solid;
}

/// A closed corridor, 10 m by 2 m, and a room of 4 m by 4 m behind a gap of 1.4 m in its north wall.
RunInfo Info() {
  RunInfo info;
  info.reason = "explored 20 m2";
  info.world.solids = {Box(5, -1.05, 10.2, 0.1),  Box(-0.05, 0, 0.1, 2),  Box(10.05, 0, 0.1, 2),
                       Box(1.15, 1.05, 2.5, 0.1), Box(7, 1.05, 6.4, 0.1), Box(1, 3, 0.1, 4),
                       Box(5, 3, 0.1, 4),         Box(3, 5.05, 4.2, 0.1)};
  return info;
}

/// Along the corridor; the robot believes to be elsewhere and turned, and is 5 cm wrong at the end. A wall is
/// told `beside_m` beside its place, and the other and the end where they are, each in the robot's frame.
RunRecord Drive(double beside_m = 0) {
  RunRecord record;
  mission_command_t order{};
  order.mission = mission_command_t::EXPLORE;
  record.orders.push_back(order);
  const Pose2 map_from_true{2, -1, 0.1};
  for (int i = 0; i <= 400; ++i) {
    world_truth_t truth{};
    truth.utime = 1'000'000 + i * 20'000;
    truth.x_m = 1 + 0.02 * i;
    record.truth.push_back(truth);
    const Pose2 believed = map_from_true * Pose2{truth.x_m - 0.05 * i / 400, 0, 0};
    pose_t pose{};
    pose.utime = truth.utime;
    pose.x_m = believed.x;
    pose.y_m = believed.y;
    pose.yaw_rad = believed.yaw;
    record.poses.push_back(pose);
  }
  floor_map_t map{};
  for (const Pose2& wall : {Pose2{5, -1 + beside_m, 0}, Pose2{7, 1, kPi}, Pose2{10, 0, kPi / 2}}) {
    const Pose2 at = map_from_true * wall;
    const double half_m = wall.x == 10 ? 0.8 : 2;
    const Eigen::Vector2f from = (at * Eigen::Vector2d(-half_m, 0)).cast<float>();
    const Eigen::Vector2f to = (at * Eigen::Vector2d(half_m, 0)).cast<float>();
    map.walls.push_back({from.x(), from.y(), to.x(), to.y()});
  }
  record.map.push_back(map);
  return record;
}

TEST(ReportExplore, WhatCanBeReachedIsCountedAndWhatOfItWasSeen) {
  const auto dut = ExploreSummaryOf(Drive(), Info());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->end, "explored 20 m2");
  EXPECT_NEAR(dut->reachable_m2, 17.6 + 14.4, 4) << "10 cm are kept off every wall";
  EXPECT_GT(dut->seen, 0.55);
  EXPECT_LT(dut->seen, 0.75) << "of the room little";
  EXPECT_NEAR(dut->driven_m, 8, 0.1);
}

TEST(ReportExplore, AGapTooNarrowForTheBaseClosesTheRoom) {
  RunInfo info = Info();
  info.world.solids.push_back(Box(3, 1.05, 0.7, 0.1));
  const auto dut = ExploreSummaryOf(Drive(), info);
  EXPECT_NEAR(dut->reachable_m2, 17.6, 2.5);
  EXPECT_GT(dut->seen, 0.98);
}

TEST(ReportExplore, TheMapIsJudgedAfterItWasTurnedAndMovedToFit) {
  const auto good = ExploreSummaryOf(Drive(), Info());
  EXPECT_NEAR(good->wall_m, 9.6, 0.4);
  EXPECT_LT(good->wall_error_p95_m, 0.005);
  const auto wide = ExploreSummaryOf(Drive(-0.2), Info());
  EXPECT_NEAR(wide->wall_error_p95_m, 0.1, 0.03) << "shared by both walls";
}

TEST(ReportExplore, ThePoseIsJudgedInTheFrameOfTheFirst) {
  const auto dut = ExploreSummaryOf(Drive(), Info());
  EXPECT_NEAR(dut->pose_error_m, 0.05, 1e-3);
  EXPECT_NEAR(dut->pose_error_deg, 0, 1e-3);
}

TEST(ReportExplore, OtherDrivesHaveNone) {
  RunRecord record = Drive();
  record.orders[0].mission = mission_command_t::GOTO;
  EXPECT_FALSE(ExploreSummaryOf(record, Info()));
  EXPECT_FALSE(ExploreSummaryOf(RunRecord{}, Info()));
}

}  // namespace
}  // namespace priamos::cli
