#include "planner/core/map/box_skeleton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace priamos::planner {
namespace {

LandmarkBox Box(const Pose2& at, double dx, double dy, double low, double high, bool has_edges = true) {
  return {at, {dx, dy}, low, high, has_edges, Side::kBoth};
}

bool IsUpright(const LandmarkEdge& e) {
  return (e.to - e.from).head<2>().norm() < 1e-9;
}

int CountSeen(const std::vector<LandmarkEdge>& edges, const Eigen::Vector2d& viewer) {
  return static_cast<int>(
      std::count_if(edges.begin(), edges.end(), [&](const auto& e) { return IsVisible(e, viewer); }));
}

TEST(BoxSkeleton, ABoxOnTheFloorShowsThreeUprightsAndFourTopEdgesFromACorner) {
  const auto dut = SkeletonOf(std::array{Box({0, 0, 0}, 0.4, 0.4, 0, 0.8)});
  const Eigen::Vector2d corner(-2.5, -2.5);
  int upright = 0, level = 0;
  for (const LandmarkEdge& e : dut)
    if (IsVisible(e, corner)) (IsUpright(e) ? upright : level)++;
  EXPECT_EQ(upright, 3);
  EXPECT_EQ(level, 4);  // eyes are higher than its top
}

TEST(BoxSkeleton, OfAHighBoxTheFarTopEdgesAreHidden) {
  const auto dut = SkeletonOf(std::array{Box({0, 0, 0}, 0.4, 0.4, 0, 1.8)});
  for (const LandmarkEdge& e : dut) {
    if (IsUpright(e)) continue;
    const Eigen::Vector2d beside = (e.from + e.to).head<2>() / 2;
    EXPECT_TRUE(IsVisible(e, 10 * beside));
    EXPECT_FALSE(IsVisible(e, -10 * beside));
  }
  EXPECT_EQ(CountSeen(dut, {-2.5, -0.05}), 3);  // two uprights and the top between them
}

TEST(BoxSkeleton, WhatAnotherBoxHidesIsNotSeen) {
  const auto alone = SkeletonOf(std::array{Box({0, 0, 0}, 0.4, 0.4, 0, 0.8)});
  const auto behind =
      SkeletonOf(std::array{Box({0, 0, 0}, 0.4, 0.4, 0, 0.8), Box({-0.6, 0, 0}, 0.1, 4, 0, 2.5, false)});
  EXPECT_GT(CountSeen(alone, {-3, 0}), 0);
  EXPECT_EQ(CountSeen(behind, {-3, 0}), 0);
  EXPECT_GT(CountSeen(behind, {3, 0}), 0);
}

TEST(BoxSkeleton, TurningTheBoxTurnsTheSectors) {
  const auto straight = SkeletonOf(std::array{Box({0, 0, 0}, 0.5, 0.3, 0, 1.5)});
  const auto turned = SkeletonOf(std::array{Box({0, 0, kPi / 2}, 0.5, 0.3, 0, 1.5)});
  ASSERT_EQ(straight.size(), turned.size());
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_NEAR(WrapAngle(turned[i].visible_from_rad - straight[i].visible_from_rad), kPi / 2, 0.08);
    EXPECT_NEAR(WrapAngle(turned[i].visible_to_rad - straight[i].visible_to_rad), kPi / 2, 0.08);
  }
}

TEST(BoxSkeleton, EdgesOnTheFloorAreLeftOut) {
  for (const LandmarkEdge& e : SkeletonOf(std::array{Box({0, 0, 0}, 0.4, 0.4, 0, 0.8)}))
    EXPECT_GT(std::max(e.from.z(), e.to.z()), 0.05);
}

}  // namespace
}  // namespace priamos::planner
