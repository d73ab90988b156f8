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

TEST(CornersOf, ADoorHasTwoPerLintel) {
  const LandmarkModel door = test::DoorModel();
  int uprights = 0;
  for (const LandmarkEdge& e : door.edges) uprights += e.IsVertical();
  const auto dut = CornersOf(door);
  EXPECT_EQ(int(dut.size()), uprights);
  for (const LandmarkCorner& c : dut) {
    EXPECT_NE(door.edges[c.a].IsVertical(), door.edges[c.b].IsVertical());
    const auto& end = c.meeting.a_at_from ? door.edges[c.a].from : door.edges[c.a].to;
    EXPECT_GT(end.z(), 1.9);
  }
}

}  // namespace
}  // namespace priamos::head
