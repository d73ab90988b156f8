#include "world/core/scene/built_doors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::world {
namespace {

GroundPlan TwoDoors() {
  GroundPlan map;
  for (const int id : {1, 2}) {
    DoorPlan door;
    door.id = id;
    door.x_m = 6;
    door.y_m = 3.0 * id;
    map.doors.push_back(door);
  }
  return map;
}

WorldPlan Surveyed() {
  WorldPlan plan;
  plan.survey = {.place_m = 0.1, .yaw_deg = 3, .size_sigma_m = 0.005, .narrower_m = 0.02};
  return plan;
}

TEST(BuiltDoors, WithoutErrorsTheDoorsAreAsDrawn) {
  const GroundPlan map = TwoDoors();
  const auto built = BuiltDoors(map, {}, 7);
  ASSERT_EQ(built.size(), 2U);
  EXPECT_EQ(built[1].y_m, map.doors[1].y_m);
  EXPECT_EQ(built[1].opening_width_m, map.doors[1].opening_width_m);
}

TEST(BuiltDoors, EveryDoorIsOffByItsOwnErrorsWithinTheBounds) {
  const GroundPlan map = TwoDoors();
  double narrowest_m = 1, off_m = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto built = BuiltDoors(map, Surveyed(), seed);
    EXPECT_NE(built[0].x_m - map.doors[0].x_m, built[1].x_m - map.doors[1].x_m);
    for (std::size_t i = 0; i < built.size(); ++i) {
      const Pose2 off = map.doors[i].map_from_door().Inverse() * built[i].map_from_door();
      EXPECT_LE(std::max(std::abs(off.x), std::abs(off.y)), 0.1);
      EXPECT_LE(std::abs(off.yaw), Radians(3) + 1e-9);
      off_m = std::max(off_m, std::abs(off.x));
      const double wider_m = built[i].opening_width_m - map.doors[i].opening_width_m;
      EXPECT_LE(wider_m, 0.015 + 1e-9);
      EXPECT_GE(wider_m, -0.035 - 1e-9);
      narrowest_m = std::min(narrowest_m, wider_m);
    }
  }
  EXPECT_GT(off_m, 0.09);
  EXPECT_LT(narrowest_m, -0.02);
}

TEST(BuiltDoors, WhatTheWorldSaysOfADoorIsAddedAndTheSeedDecidesTheRest) {
  WorldPlan plan = Surveyed();
  const double drawn_m = BuiltDoors(TwoDoors(), plan, 3)[1].opening_width_m;
  plan.doors.emplace_back();
  plan.doors[0].id = 2;
  plan.doors[0].built_dwidth_m = -0.1;
  EXPECT_NEAR(BuiltDoors(TwoDoors(), plan, 3)[1].opening_width_m, drawn_m - 0.1, 1e-12);
  EXPECT_NE(BuiltDoors(TwoDoors(), plan, 4)[1].opening_width_m, drawn_m - 0.1);
}

TEST(BuiltDoors, AFrameKeepsSomeBreadth) {
  GroundPlan map = TwoDoors();
  map.doors[0].frame_width_m = 0.004;
  map.doors[0].frame_protrusion_m = 0.004;
  WorldPlan plan = Surveyed();
  plan.survey.size_sigma_m = 0.03;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    EXPECT_GE(BuiltDoors(map, plan, seed)[0].frame_width_m, 0.003);
    EXPECT_GE(BuiltDoors(map, plan, seed)[0].frame_protrusion_m, 0.003);
  }
}

}  // namespace
}  // namespace priamos::world
