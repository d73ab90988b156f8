#include "planner/core/path/swept_footprint.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "test/planner/core/plans.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::planner {
namespace {

SweptFootprint Shipped() {
  return SweptFootprint(Footprint{}, ObstacleMap(ShippedPlan()));
}

/// Smallest distance on 400 poses of a line: slow, and without any thought.
double Sampled(const SweptFootprint& space, const Pose2& from, const Pose2& to) {
  double least_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 400; ++i) least_m = std::min(least_m, space.DistanceAt(Between(from, to, i / 400.0)));
  return least_m;
}

Pose2 AnyPose() {
  return {support::Between(0.3, 9.7), support::Between(0.3, 4.5), support::Between(-kPi, kPi)};
}

TEST(SweptFootprintTest, TheHeadingTurnsTheShorterWayRound) {
  const Pose2 middle = Between({0, 0, 3.0}, {1, 2, -3.0}, 0.5);
  EXPECT_NEAR(middle.x, 0.5, 1e-12);
  EXPECT_NEAR(middle.y, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(middle.yaw), kPi, 1e-12);
}

TEST(SweptFootprintTest, SixCentimetresAreFreeBesideTheBaseInTheDoor) {
  const auto gap = Shipped().Along({4, 2.4, 0}, {8, 2.4, 0});
  EXPECT_NEAR(gap.distance_m, 0.06, 1e-9);
}

TEST(SweptFootprintTest, ATouchedObstacleIsAtDistanceZero) {
  EXPECT_EQ(Shipped().Along({4, 1.4, 0}, {8, 1.4, 0}).distance_m, 0);
}

TEST(SweptFootprintTest, WithoutObstaclesEverythingIsFree) {
  const SweptFootprint dut(Footprint{}, ObstacleMap(GroundPlan{}));
  EXPECT_TRUE(dut.IsFree({0, 0, 0}, {9, 9, 3}, 5));
  EXPECT_EQ(dut.LeewayOf({0, 0, 0}, {9, 9, 3}, 0.1).left_m, 2.0);
}

TEST(SweptFootprintTest, WhatWasAddedIsInTheWay) {
  SweptFootprint dut = Shipped();
  EXPECT_TRUE(dut.IsFree({1, 2.4, 0}, {5, 2.4, 0}, 0.1));
  dut.Add("box", {{3, 2.4, 0}, {0.2, 0.2}});
  EXPECT_FALSE(dut.IsFree({1, 2.4, 0}, {5, 2.4, 0}, 0.1));
  EXPECT_EQ(dut.Along({1, 2.4, 0}, {5, 2.4, 0}).obstacle, "box");
}

TEST(SweptFootprintTest, LeewayEndsAtTheWalls) {
  const Leeway leeway = Shipped().LeewayOf({1, 1.4, 0}, {4, 1.4, 0}, 0.1);
  EXPECT_NEAR(leeway.right_m, 0.9, 1e-9) << "1.4 m less half a base and the margin, in steps of 10 cm";
  EXPECT_NEAR(leeway.left_m, 2.0, 1e-9);
}

RC_GTEST_PROP(SweptFootprintTest, TheSmallestGapIsTheOneThatDenseSamplesShow, ()) {
  const SweptFootprint dut = Shipped();
  const Pose2 from = AnyPose(), to = AnyPose();
  const double sampled_m = Sampled(dut, from, to), found_m = dut.Along(from, to).distance_m;
  RC_ASSERT(std::abs(found_m - sampled_m) < 0.03);
}

RC_GTEST_PROP(SweptFootprintTest, FreeMeansThatTheGapIsNotSmallerThanTheMargin, ()) {
  const SweptFootprint dut = Shipped();
  const Pose2 from = AnyPose(), to = AnyPose();
  const double margin_m = support::Between(0.0, 0.5), gap_m = Sampled(dut, from, to);
  if (gap_m < margin_m - 0.03) RC_ASSERT(!dut.IsFree(from, to, margin_m));
  if (gap_m > margin_m + 0.03) RC_ASSERT(dut.IsFree(from, to, margin_m));
}

}  // namespace
}  // namespace priamos::planner
