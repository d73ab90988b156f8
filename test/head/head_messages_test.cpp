#include "head/head_messages.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace priamos::head
