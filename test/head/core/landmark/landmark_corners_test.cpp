#include "head/core/landmark/landmark_corners.hpp"

#include <gtest/gtest.h>

#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

LandmarkEdge Edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {from, to, -kPi, kPi, 0};
}

TEST(MeetingOf, TellsWhichEndsMeet) {
  const LandmarkEdge upright = Edge({0, 0, 0}, {0, 0, 2}), level = Edge({0, 1, 2}, {0, 0.004, 2});
  const auto dut = MeetingOf(upright, level);
  ASSERT_TRUE(dut);
  EXPECT_FALSE(dut->a_at_from);
  EXPECT_FALSE(dut->b_at_from);
  const auto back = MeetingOf(Edge(upright.to, upright.from), level);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->a_at_from);
}

TEST(MeetingOf, WhatGoesOnOrEndsOnAnEdgeIsNoCorner) {
  const LandmarkEdge upright = Edge({0, 0, 0}, {0, 0, 2});
  EXPECT_FALSE(MeetingOf(upright, Edge({0, 0, 2}, {0, 0, 3})));
  EXPECT_FALSE(MeetingOf(upright, Edge({0, 0, 1}, {0, 1, 1})));
  EXPECT_FALSE(MeetingOf(upright, Edge({0, 0.03, 2}, {0, 1, 2})));
}

TEST(MeetingOf, ADoorHasTwoCornersPerLintel) {
  const std::vector<LandmarkEdge> edges = test::DoorModel().edges;
  int uprights = 0, corners = 0;
  for (const LandmarkEdge& e : edges) uprights += e.IsVertical();
  for (std::size_t a = 0; a < edges.size(); ++a) {
    for (std::size_t b = a + 1; b < edges.size(); ++b) {
      const auto dut = MeetingOf(edges[a], edges[b]);
      if (!dut) continue;
      ++corners;
      EXPECT_NE(edges[a].IsVertical(), edges[b].IsVertical());
      EXPECT_GT((dut->a_at_from ? edges[a].from : edges[a].to).z(), 1.9);
    }
  }
  EXPECT_EQ(corners, uprights);
}

}  // namespace
}  // namespace priamos::head
