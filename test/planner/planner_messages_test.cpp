#include "planner/planner_messages.hpp"

#include <gtest/gtest.h>

#include "bus/node.hpp"

namespace priamos::planner {
namespace {

const Time kNow = FromUtime(1'234'567'000);

TEST(PlannerMessages, PoseKeepsItsCovariance) {
  pose_t message{};
  message.utime = ToUtime(kNow);
  message.x_m = 1;
  message.y_m = -2;
  message.yaw_rad = 0.5;
  message.vx_m_s = 0.3;
  message.vy_m_s = -0.1;
  message.wz_rad_s = 0.2;
  message.sigma_x_m = 0.1;
  message.sigma_yaw_rad = 0.02;
  message.rho_x_yaw = -0.5;
  const RobotPose dut = FromMessage(message);
  EXPECT_EQ(dut.stamp, kNow);
  EXPECT_DOUBLE_EQ(dut.map_from_base.y, -2);
  EXPECT_DOUBLE_EQ(dut.velocity.wz, 0.2);
  EXPECT_NEAR(dut.covariance(0, 2), -0.5 * 0.1 * 0.02, 1e-12);
  EXPECT_NEAR(dut.covariance(2, 2), 0.0004, 1e-12);
}

TEST(PlannerMessages, EveryDriveModeHasItsOwnMeaning) {
  drive_status_t message{};
  message.path_id = 12;
  message.mode = drive_status_t::BLOCKED;
  message.limit = drive_status_t::LIMIT_SONAR;
  EXPECT_EQ(FromMessage(message).mode, DriveMode::kBlocked);
  EXPECT_EQ(FromMessage(message).path_id, 12);
  EXPECT_EQ(FromMessage(message).limit, "an echo is too near");
  message.mode = drive_status_t::ARRIVED;
  EXPECT_EQ(FromMessage(message).mode, DriveMode::kArrived);
  message.mode = drive_status_t::FOLLOWING;
  EXPECT_EQ(FromMessage(message).mode, DriveMode::kFollowing);
  message.mode = drive_status_t::HOLDING;
  EXPECT_EQ(FromMessage(message).mode, DriveMode::kHolding);
  message.mode = 99;
  EXPECT_EQ(FromMessage(message).mode, DriveMode::kIdle);
}

TEST(PlannerMessages, ARobotThatKeepsItsPathWasTouchedAndHasTouchedNothing) {
  drive_status_t message{};
  message.limit = drive_status_t::LIMIT_TOUCHED;
  for (const int mode : {drive_status_t::FOLLOWING, drive_status_t::BLOCKED}) {
    message.mode = static_cast<std::int8_t>(mode);
    EXPECT_FALSE(FromMessage(message).touched);
    EXPECT_EQ(FromMessage(message).limit, "somebody touched the standing robot");
  }
  message.mode = drive_status_t::HOLDING;
  EXPECT_TRUE(FromMessage(message).touched);
  EXPECT_EQ(FromMessage(message).limit, "the robot touched something");
}

TEST(PlannerMessages, ALeafHangsWhereTheHeadSawItOrWasNotSeen) {
  door_seen_t message{};
  message.utime_exposure = 7'000'000;
  message.landmark_id = 3;
  message.open_rad = 0.8;
  message.sigma_rad = 0.02;
  message.log_odds = 6;
  EXPECT_EQ(FromMessage(message).hinge, "");
  message.hinge = door_seen_t::LEFT;
  const LeafSighting left = FromMessage(message);
  EXPECT_EQ(left.hinge, "left");
  EXPECT_EQ(left.stamp, FromUtime(7'000'000));
  EXPECT_EQ(left.landmark_id, 3);
  EXPECT_EQ(left.open_rad, 0.8);
  EXPECT_EQ(left.sigma_rad, 0.02);
  EXPECT_EQ(left.log_odds, 6);
  message.hinge = door_seen_t::RIGHT;
  EXPECT_EQ(FromMessage(message).hinge, "right");
}

TEST(PlannerMessages, FoundLandmarkIsNotYetACorrectedPose) {
  landmark_fix_t message{};
  message.verdict = landmark_fix_t::FOUND;
  EXPECT_FALSE(FromMessage(message).has_value());
  message.verdict = landmark_fix_t::AMBIGUOUS;
  message.request_id = 9;
  const auto dut = FromMessage(message);
  ASSERT_TRUE(dut.has_value());
  EXPECT_FALSE(dut->ok);
  EXPECT_EQ(dut->request_id, 9);
  EXPECT_EQ(dut->reason, "ambiguous");
}

TEST(PlannerMessages, ALandmarkElsewhereIsToldAsThat) {
  landmark_fix_t message{};
  message.verdict = landmark_fix_t::ELSEWHERE;
  EXPECT_TRUE(FromMessage(message)->elsewhere);
  message.verdict = landmark_fix_t::TOO_FEW_EDGES;
  EXPECT_FALSE(FromMessage(message)->elsewhere);
}

TEST(PlannerMessages, CorrectionDecidesTheLook) {
  pose_correction_t message{};
  message.request_id = 9;
  message.verdict = pose_correction_t::APPLIED;
  EXPECT_TRUE(FromMessage(message).ok);
  message.verdict = pose_correction_t::IMPLAUSIBLE;
  EXPECT_FALSE(FromMessage(message).ok);
  EXPECT_EQ(FromMessage(message).reason, "the robot found the fix implausible");
}

TEST(PlannerMessages, VerdictsAndLimitsHaveDifferentWords) {
  for (int verdict = 0; verdict < 8; ++verdict)
    EXPECT_NE(FixVerdictText(verdict), FixVerdictText(verdict + 1)) << verdict;
  for (int limit = 0; limit < drive_status_t::LIMIT_ESTOP; ++limit)
    EXPECT_NE(DriveLimitText(limit), DriveLimitText(limit + 1)) << limit;
  EXPECT_EQ(FixVerdictText(99), "unknown verdict");
  EXPECT_EQ(CorrectionVerdictText(99), "unknown verdict");
  EXPECT_EQ(DriveLimitText(99), "unknown limit");
}

TEST(PlannerMessages, LandmarkSurvivesTheWire) {
  DoorPlan plan;
  plan.frame_over_wall = 1.5;
  const Landmark door = MakeDoorLandmark(plan);
  const auto message = bus::Decode<landmark_model_t>(bus::Encode(ToMessage(door)));
  EXPECT_EQ(message.landmark_id, 1);
  ASSERT_EQ(message.n_edges, static_cast<int>(door.edges.size()));
  for (int i = 0; i < message.n_edges; ++i) {
    const auto& edge = message.edges[i];
    EXPECT_EQ((Eigen::Vector3d(edge.x1_m, edge.y1_m, edge.z1_m)), door.edges[i].from);
    EXPECT_EQ((Eigen::Vector3d(edge.x2_m, edge.y2_m, edge.z2_m)), door.edges[i].to);
    EXPECT_NEAR(edge.visible_from_rad, door.edges[i].visible_from_rad, 1e-6);
    EXPECT_NEAR(edge.visible_to_rad, door.edges[i].visible_to_rad, 1e-6);
    EXPECT_EQ(edge.side, static_cast<int>(door.edges[i].side));
    EXPECT_NEAR(edge.grey_ratio, door.edges[i].grey_ratio.value_or(0), 1e-6);
  }
}

TEST(PlannerMessages, PathSurvivesTheWire) {
  const PathOrder path{.path_id = 7,
                       .speed_m_s = 0.3,
                       .points = {{1, 2, 0.1}, {3, 4, -0.2}},
                       .leeway = {{1.5, 0.3}},
                       .estop_changes = 201};
  const auto message = bus::Decode<path_t>(bus::Encode(ToMessage(path, kNow)));
  EXPECT_EQ(message.utime, ToUtime(kNow));
  EXPECT_EQ(message.path_id, 7);
  EXPECT_EQ(message.estop_changes, 201);
  EXPECT_EQ(message.speed_m_s, 0.3);
  ASSERT_EQ(message.n_points, 2);
  EXPECT_EQ(message.points[1].x_m, 3);
  EXPECT_EQ(message.points[1].y_m, 4);
  EXPECT_EQ(message.points[1].yaw_rad, -0.2);
  EXPECT_EQ(message.points[0].left_m, 1.5);
  EXPECT_EQ(message.points[0].right_m, 0.3);
  EXPECT_EQ(message.points[1].left_m, 0);
}

TEST(PlannerMessages, WhatDoesNotFitIsRefused) {
  Landmark landmark;
  landmark.edges.resize(25);
  EXPECT_THROW(ToMessage(landmark), std::invalid_argument);
  PathOrder path;
  path.points.resize(17);
  EXPECT_THROW(ToMessage(path, kNow), std::invalid_argument);
}

TEST(PlannerMessages, LookNamesLandmarkAndSide) {
  const auto message = ToMessage(LookOrder{3, 5, Side::kRight}, kNow);
  EXPECT_EQ(message.request_id, 3);
  EXPECT_EQ(message.landmark_id, 5);
  EXPECT_EQ(message.side, 2);
}

}  // namespace
}  // namespace priamos::planner
