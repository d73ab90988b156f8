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

}  // namespace
}  // namespace priamos::head
