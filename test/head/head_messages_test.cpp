#include "head/head_messages.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "bus/own_types.hpp"
#include "bus/schema/schema.hpp"
#include "common/covariance.hpp"
#include "common/robot/robot_drawing.hpp"

namespace priamos::head {
namespace {

LookAnswer Answer(std::size_t n_edges) {
  LookAnswer answer;
  answer.order = {12, 3, 2};
  answer.exposure = FromUtime(5'000'000);
  answer.fix.verdict = Verdict::kAmbiguous;
  answer.view.camera = 1;
  answer.view.n_left_out = 4;
  for (std::size_t i = 0; i < n_edges; ++i) {
    const double x = static_cast<double>(i);
    answer.view.edges.push_back({static_cast<ViewedEdge::Kind>(i % 3), {x, 10.5}, {700.25, 20 + x}});
  }
  return answer;
}

TEST(HeadMessagesTest, AViewComesBackAsItWas) {
  const LookAnswer answer = Answer(7);
  const landmark_view_t message = ViewMessage(answer);
  EXPECT_EQ(message.utime_exposure, 5'000'000);
  EXPECT_EQ(message.request_id, 12);
  EXPECT_EQ(message.landmark_id, 3);
  EXPECT_EQ(message.side, 2);
  EXPECT_EQ(message.verdict, landmark_fix_t::AMBIGUOUS);
  const LandmarkView view = FromMessage(message);
  EXPECT_EQ(view.camera, 1);
  EXPECT_EQ(view.n_left_out, 4);
  ASSERT_EQ(view.edges.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(view.edges[i].kind, answer.view.edges[i].kind);
    EXPECT_EQ(view.edges[i].p, answer.view.edges[i].p);
    EXPECT_EQ(view.edges[i].q, answer.view.edges[i].q);
  }
}

TEST(HeadMessagesTest, ADoorThatWasFoundHasItsErrorsAlongTheWallAndAcross) {
  DoorTrack door;
  door.id = 4;
  door.seen = FromUtime(7'000'000);
  door.place.map_from_thing = {6, 1.1, Radians(90)};
  door.place.covariance << 0.04 * 0.04, 0, 0, 0.01 * 0.01;  // of x, which is along the wall, and y
  door.width_m = 0.9;
  door.looks = 100;
  door.state.log_likelihood = {5, 1, 0};
  const door_found_t message = ToMessage(door, DoorState::kClosed);
  EXPECT_EQ(message.utime_seen, 7'000'000);
  EXPECT_EQ(message.id, 4);
  EXPECT_NEAR(message.sigma_along_m, 0.04, 1e-9);
  EXPECT_NEAR(message.sigma_across_m, 0.01, 1e-9);
  EXPECT_EQ(message.state, door_found_t::CLOSED);
  EXPECT_EQ(message.log_odds, 4);
  EXPECT_EQ(message.looks, 63) << "as many as the field has";
}

TEST(HeadMessagesTest, AnObjectHasItsErrorsAlongItsFrontAndAcross) {
  SceneTrack track;
  track.id = 9;
  track.seen = FromUtime(7'000'000);
  track.place.map_from_thing = {2, 1, Radians(90)};
  track.place.covariance << 0.04 * 0.04, 0, 0, 0.01 * 0.01;  // of x, which is along the front, and y
  track.object.kind = ObjectKind::kBox;
  track.object.sigma_yaw_rad = 2;
  track.object.width_m = 0.6;
  track.object.depth_m = 0.4;
  track.object.top_m = 3;
  track.looks = 100;
  const scene_object_t message = ToMessage(track, false);
  EXPECT_EQ(message.utime_seen, 7'000'000);
  EXPECT_EQ(message.id, 9);
  EXPECT_EQ(message.kind, scene_object_t::BOX);
  EXPECT_EQ(message.x_m, 2);
  EXPECT_EQ(message.width_m, 0.6);
  EXPECT_EQ(message.depth_m, 0.4);
  EXPECT_EQ(message.top_m, 2.5) << "its bound";
  EXPECT_NEAR(message.sigma_along_m, 0.04, 1e-9);
  EXPECT_NEAR(message.sigma_across_m, 0.01, 1e-9);
  EXPECT_EQ(message.sigma_yaw_rad, 0.63) << "its bound";
  EXPECT_EQ(ToMessage(track, true).looks, 0) << "it has gone";
  EXPECT_EQ(message.looks, 63) << "as many as the field has";
}

TEST(HeadMessagesTest, ALookThatFoundNoDoorSaysNothingOfALeaf) {
  EXPECT_FALSE(DoorSeenMessage(Answer(1)));
}

TEST(HeadMessagesTest, ALeafIsToldWithItsLook) {
  LookAnswer answer = Answer(1);
  answer.leaf = LeafSight{LeafSight::Hinge::kRight, 0.8, 0.7, 55};
  const auto message = DoorSeenMessage(answer);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->utime_exposure, 5'000'000);
  EXPECT_EQ(message->request_id, 12);
  EXPECT_EQ(message->landmark_id, 3);
  EXPECT_EQ(message->hinge, door_seen_t::RIGHT);
  EXPECT_EQ(message->open_rad, 0.8);
  EXPECT_EQ(message->sigma_rad, 0.5) << "its bound";
  EXPECT_EQ(message->log_odds, 40) << "its bound";
}

TEST(HeadMessagesTest, AFixTellsWhatOfItsCovarianceIsItsOwn) {
  LookAnswer answer = Answer(1);
  answer.fix.verdict = Verdict::kFound;
  answer.fix.covariance = Eigen::Vector3d(1e-4, 4e-4, 1e-6).asDiagonal();
  answer.fix.own_share = 0.125;
  EXPECT_EQ(ToMessage(answer).own_share, 0.125);
  answer.fix.own_share = 1.0000001;  // rounding
  EXPECT_EQ(ToMessage(answer).own_share, 1);
}

TEST(HeadMessagesTest, AViewHasRoomForTwentyEightEdgesAndCountsTheOthers) {
  const landmark_view_t message = ViewMessage(Answer(60));
  EXPECT_EQ(message.n_edges, 28);
  EXPECT_EQ(message.edges.size(), 28u);
  EXPECT_EQ(message.n_left_out, 36);
}

TEST(HeadMessagesTest, AnEdgeOfUnknownKindIsLeftOut) {
  landmark_view_t message = ViewMessage(Answer(2));
  message.edges[0].kind = 9;
  EXPECT_EQ(FromMessage(message).edges.size(), 1u);
}

ObstaclePiece Piece(ObstaclePiece::Kind kind, double y, double height_m) {
  return {kind, {2.0, y, 0}, {2.1, y + 0.1, 0}, height_m, 0.002};
}

TEST(HeadMessagesTest, ObstaclesComeBackAsTheyWere) {
  ObstacleLines lines;
  lines.verdict = ObstacleLines::kObstacle;
  lines.seen_share = 0.75;
  lines.pieces = {Piece(ObstaclePiece::kDown, -0.5, -0.125), Piece(ObstaclePiece::kMissing, 0, 0),
                  Piece(ObstaclePiece::kUp, 0.25, 0.03)};
  const obstacle_line_t message = ToMessage(lines, FromUtime(7'000'000));
  EXPECT_EQ(message.utime_exposure, 7'000'000);
  EXPECT_EQ(message.verdict, obstacle_line_t::OBSTACLE);
  EXPECT_EQ(message.n_segments, 3);
  const ObstacleLines back = FromMessage(message);
  EXPECT_EQ(back.verdict, lines.verdict);
  EXPECT_EQ(back.seen_share, lines.seen_share);
  ASSERT_EQ(back.pieces.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back.pieces[i].kind, lines.pieces[i].kind);
    EXPECT_NEAR(back.pieces[i].height_m, lines.pieces[i].height_m, 1e-6);
    EXPECT_NEAR(back.pieces[i].right.y(), lines.pieces[i].right.y(), 1e-6);
    EXPECT_NEAR(back.pieces[i].left.x(), 2.1, 1e-6);
  }
}

TEST(HeadMessagesTest, OfManyPiecesTheHighestAreKeptInTheirOrder) {
  ObstacleLines lines;
  for (int i = 0; i < 6; ++i) {
    lines.pieces.push_back(Piece(ObstaclePiece::kMissing, -1 + 0.2 * i, 0));
    lines.pieces.push_back(Piece(ObstaclePiece::kUp, -0.9 + 0.2 * i, 0.02 + 0.01 * i));
  }
  const obstacle_line_t message = ToMessage(lines, FromUtime(1));
  EXPECT_EQ(message.n_segments, 4);
  EXPECT_EQ(message.n_left_out, 8);
  int up = 0;
  for (std::size_t i = 0; i < message.segments.size(); ++i) {
    up += message.segments[i].kind == obstacle_segment_t::UP;
    if (i > 0) {
      EXPECT_GT(message.segments[i].y1_m, message.segments[i - 1].y1_m);
    }
  }
  EXPECT_EQ(up, 4);
  EXPECT_NEAR(message.segments.back().height_m, 0.07, 1e-6);
}

TEST(HeadMessagesTest, AWallOnTheFarLineLeavesRoomForADuctOnTheNearOne) {
  ObstacleLines lines;
  for (int i = 0; i < 6; ++i) {
    lines.pieces.push_back(Piece(ObstaclePiece::kUp, -1 + 0.2 * i, 0.2));
    lines.pieces.back().laser = 1;
  }
  lines.pieces.push_back(Piece(ObstaclePiece::kUp, 0.9, 0.03));
  const obstacle_line_t message = ToMessage(lines, FromUtime(1));
  ASSERT_EQ(message.n_segments, 4);
  EXPECT_NEAR(message.segments.back().height_m, 0.03, 1e-6);
}

TEST(HeadMessagesTest, WhatTheMotorsReportIsReadWhole) {
  head_state_t message{};
  message.utime = 3'000'000;
  message.pan_rad = 0.25;
  message.tilt_rad = -0.125;
  message.vergence_rad[0] = -0.02;
  message.vergence_rad[1] = 0.03;
  message.zoom_step[0] = 650;
  message.zoom_step[1] = 651;
  message.focus_step[0] = 1600;
  message.focus_step[1] = 1601;
  message.moving = true;
  const HeadReport dut = FromMessage(message);
  const HeadSetting expected{0.25, -0.125, {-0.02, 0.03}, {650, 651}, {1600, 1601}};
  EXPECT_EQ(dut.time, FromUtime(3'000'000));
  EXPECT_TRUE(dut.moving);
  EXPECT_EQ(dut.setting.pan_rad, expected.pan_rad);
  EXPECT_EQ(dut.setting.tilt_rad, expected.tilt_rad);
  EXPECT_EQ(dut.setting.vergence_rad, expected.vergence_rad);
  EXPECT_EQ(dut.setting.zoom_step, expected.zoom_step);
  EXPECT_EQ(dut.setting.focus_step, expected.focus_step);
}

TEST(HeadMessagesTest, ACommandSaysTheWholeSetting) {
  const HeadSetting setting{0.25, -0.125, {-0.02, 0.03}, {650, 651}, {1600, 1601}};
  const head_command_t dut = ToMessage(setting, FromUtime(42));
  EXPECT_EQ(dut.utime, 42);
  EXPECT_EQ(dut.pan_rad, 0.25);
  EXPECT_EQ(dut.tilt_rad, -0.125);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(dut.vergence_rad[i], setting.vergence_rad[i]);
    EXPECT_EQ(dut.zoom_step[i], setting.zoom_step[i]);
    EXPECT_EQ(dut.focus_step[i], setting.focus_step[i]);
  }
}

TEST(HeadMessagesTest, ATriggerAndItsFramesSpeakOfTheSamePicture) {
  const camera_trigger_t trigger = TriggerMessage(77, 12, FromUtime(42));
  EXPECT_EQ(trigger.utime, 42);
  EXPECT_EQ(trigger.frame_id, 77);
  EXPECT_EQ(trigger.cameras, 12);
  camera_frame_t message{};
  message.utime_exposure = 43;
  message.frame_id = 77;
  message.camera = 2;
  message.slot = 5;
  message.width_px = 768;
  message.height_px = 576;
  const FrameNotice dut = FromMessage(message);
  EXPECT_EQ(dut.exposure, FromUtime(43));
  EXPECT_EQ(dut.frame_id, 77);
  EXPECT_EQ(dut.camera, 2);
  EXPECT_EQ(dut.slot, 5);
  EXPECT_EQ(dut.width, 768);
  EXPECT_EQ(dut.height, 576);
}

TEST(HeadMessagesTest, ASideThatDoesNotExistIsTheNearestOne) {
  for (const auto& [side, expected] : {std::pair(-3, 0), {0, 0}, {1, 1}, {2, 2}, {9, 2}}) {
    look_request_t message{};
    message.request_id = 5;
    message.landmark_id = 6;
    message.side = static_cast<std::int8_t>(side);
    EXPECT_EQ(FromMessage(message), (LookOrder{5, 6, expected}));
  }
}

TEST(HeadMessagesTest, AWishWithoutACredibleLifeIsNeverValid) {
  head_drive_t message{};
  message.utime = 9;
  message.session = 3;
  message.sequence = 4;
  message.pan_rad_s = 0.1;
  message.tilt_rad_s = 0.2;
  message.vergence_rad_s = 0.3;
  message.zoom_step_s = 40;
  message.focus_step_s = 50;
  message.time_to_live_s = 0.25;
  const HeadWish dut = FromMessage(message);
  EXPECT_EQ(dut.time_to_live, std::chrono::milliseconds(250));
  EXPECT_EQ(dut.time, FromUtime(9));
  EXPECT_EQ(dut.session, 3);
  EXPECT_EQ(dut.sequence, 4);
  EXPECT_EQ(dut.pan_rad_s, 0.1);
  EXPECT_EQ(dut.tilt_rad_s, 0.2);
  EXPECT_EQ(dut.vergence_rad_s, 0.3);
  EXPECT_EQ(dut.zoom_step_s, 40);
  EXPECT_EQ(dut.focus_step_s, 50);
  for (const double life : {-0.1, 0.0, 1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    message.time_to_live_s = life;
    EXPECT_EQ(FromMessage(message).time_to_live, Duration::zero()) << life;
  }
}

TEST(HeadMessagesTest, APoseNeedsFiniteNumbers) {
  pose_t message{};
  message.utime = 7;
  message.x_m = 1;
  message.y_m = 2;
  message.yaw_rad = 4;
  message.vx_m_s = 0.3;
  message.vy_m_s = 0.1;
  message.wz_rad_s = -0.2;
  message.sigma_x_m = 0.1;
  message.sigma_y_m = 0.2;
  message.sigma_yaw_rad = 0.05;
  message.rho_x_y = 0.5;
  const auto dut = FromMessage(message);
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->time, FromUtime(7));
  EXPECT_EQ(dut->map_from_base.x, 1);
  EXPECT_NEAR(dut->map_from_base.yaw, 4 - 2 * kPi, 1e-12);
  EXPECT_EQ(dut->twist.wz, -0.2);
  EXPECT_NEAR(dut->covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(dut->covariance(1, 0), 0.5 * 0.1 * 0.2, 1e-12);
  for (double pose_t::*field :
       {&pose_t::x_m, &pose_t::yaw_rad, &pose_t::vy_m_s, &pose_t::sigma_yaw_rad, &pose_t::rho_y_yaw}) {
    pose_t damaged = message;
    damaged.*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(FromMessage(damaged));
  }
}

TEST(HeadMessagesTest, EdgesWithoutLengthAreLeftOutOfALandmark) {
  landmark_model_t message{};
  message.landmark_id = 12;
  message.x_m = 3;
  message.yaw_rad = -4;
  message.edges.resize(2);
  message.edges[0].z2_m = 2;
  message.edges[0].side = 1;
  message.edges[0].visible_from_rad = -1;
  message.edges[0].visible_to_rad = 1;
  message.edges[0].grey_ratio = 0.4F;
  message.edges[1].z2_m = 0.01;
  message.n_edges = 2;
  const auto dut = FromMessage(message);
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->id, 12);
  EXPECT_NEAR(dut->map_from_landmark.yaw, 2 * kPi - 4, 1e-12);
  ASSERT_EQ(dut->edges.size(), 1u);
  EXPECT_EQ(dut->edges[0].to, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(dut->edges[0].side, 1);
  EXPECT_EQ(dut->edges[0].visible_to_rad, 1);
  EXPECT_NEAR(dut->edges[0].grey_ratio.value(), 0.4, 1e-6);
  message.edges[0].grey_ratio = 0;
  EXPECT_FALSE(FromMessage(message)->edges[0].grey_ratio) << "not known";
  message.edges[0].grey_ratio = 99;
  EXPECT_EQ(FromMessage(message)->edges[0].grey_ratio, 3);
  message.edges[0].grey_ratio = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(FromMessage(message));
  message.edges[0].grey_ratio = 0;
  message.edges[1].y1_m = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(FromMessage(message));
}

TEST(HeadMessagesTest, OnlyAFoundLandmarkHasAPlace) {
  LookAnswer answer = Answer(0);
  answer.map_from_landmark = {6, 7, 0.5};
  answer.fix.base_from_landmark = {2, 0.5, 0.1};
  answer.fix.covariance = Eigen::Vector3d(1e-4, 4e-4, 1e-6).asDiagonal();
  answer.fix.n_matched = 300;
  answer.fix.residual_px = 50;
  landmark_fix_t dut = ToMessage(answer);
  EXPECT_EQ(dut.verdict, landmark_fix_t::AMBIGUOUS);
  EXPECT_EQ(dut.model_x_m, 6);
  EXPECT_EQ(dut.model_yaw_rad, 0.5);
  EXPECT_EQ(dut.x_m, 0);
  EXPECT_EQ(dut.sigma_x_m, 0);
  EXPECT_EQ(dut.n_matched, 255) << "what the message can say";
  EXPECT_EQ(dut.residual_px, 20);
  answer.fix.verdict = Verdict::kFound;
  dut = ToMessage(answer);
  EXPECT_EQ(dut.x_m, 2);
  EXPECT_EQ(dut.y_m, 0.5);
  EXPECT_EQ(dut.yaw_rad, 0.1);
  EXPECT_NEAR(dut.sigma_x_m, 0.01, 1e-12);
  EXPECT_NEAR(dut.sigma_y_m, 0.02, 1e-12);
  EXPECT_NEAR(dut.sigma_yaw_rad, 0.001, 1e-12);
}

TEST(HeadMessagesTest, TheMessageGoesAsFarAsTheMotorsOfTheDrawing) {
  const bus::Schema schema = bus::OwnTypes();
  const auto most = [&](const std::string& field) {
    for (const bus::Field& f : schema.Find("head_command_t")->fields)
      if (f.name == field) return f.annotation.max.value().value;
    return 0.0;
  };
  EXPECT_EQ(most("pan_rad"), kDrawnHead.most_pan_rad);
  EXPECT_EQ(most("tilt_rad"), kDrawnHead.most_tilt_rad);
  EXPECT_EQ(most("vergence_rad"), kDrawnHead.most_vergence_rad);
  EXPECT_EQ(most("zoom_step"), kDrawnHead.most_step);
  EXPECT_EQ(most("focus_step"), kDrawnHead.most_step);
}

}  // namespace
}  // namespace priamos::head
