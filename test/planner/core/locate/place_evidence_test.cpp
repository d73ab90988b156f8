#include "planner/core/locate/place_evidence.hpp"

#include <gmock/gmock.h>

#include "simulated_drive.hpp"

namespace priamos::planner {
namespace {

using testing::SizeIs;

HeardPiece PieceAt(double x_m, double y_m, double yaw_deg, double length_m) {
  return {{x_m, y_m, Radians(yaw_deg)}, length_m};
}

DrivenWay Straight() {
  DrivenWay way;
  for (int i = 0; i <= 20; ++i) way.trail.push_back({0.2 * i, 0, 0});
  return way;
}

TEST(WallsAt, AWallIsWhereTheFrameOfTheWayPutsIt) {
  DrivenWay way = Straight();
  way.pieces = {PieceAt(2, -1, 0, 3)};
  const auto dut = WallsAt(way, {10, 5, kPi / 2}).walls;
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_NEAR(dut[0].x_m, 11, 1e-9);
  EXPECT_NEAR(dut[0].y_m, 7, 1e-9);
  EXPECT_NEAR(dut[0].yaw_deg, 90, 1e-9);
  EXPECT_NEAR(dut[0].length_m, 3, 1e-9);
}

TEST(WallsAt, WhatTheBaseDroveOverIsNoWall) {
  DrivenWay way = Straight();
  way.pieces = {PieceAt(2, 0, 90, 2), PieceAt(2, -1, 0, 3)};
  EXPECT_THAT(WallsAt(way, {}).walls, SizeIs(1));
}

/// A room of 6 m x 4.4 m, and a robot that drives along its south wall.
struct Evidence {
  Evidence() {
    AddRoom(plan, {0, 0}, {6, 4.4});
    dut.emplace(PlaceSearchConfig{}, plan);
    dut->Begin(FromUtime(1'000'000'000));
  }
  void DriveTo(double x_m) {
    for (; at_m < x_m; at_m += 0.1) {
      now += FromSeconds(0.4);
      dut->OnPose(now, {at_m, 1.2, 0}, std::nullopt);
    }
  }
  void Hear(int id, double x_m, double y_m, double yaw_deg, double length_m) {
    LearnedWall wall;
    wall.x_m = x_m;
    wall.y_m = y_m;
    wall.yaw_deg = yaw_deg;
    wall.length_m = length_m;
    wall.seen_s = static_cast<double>(ToUtime(now)) * 1e-6;
    dut->OnFeature({1, id, wall}, now);
  }
  GroundPlan plan;
  std::optional<PlaceEvidence> dut;
  Time now = FromUtime(1'000'000'000);
  double at_m = 1;
};

TEST(PlaceEvidence, WallsOfBothDirectionsLeaveFewPlaces) {
  Evidence e;
  e.DriveTo(4);
  e.Hear(1, 3, 0, 0, 3);
  e.Hear(2, 0, 2, -90, 2);
  e.Hear(3, 6, 2, 90, 2);
  const auto& found = e.dut->Search();
  ASSERT_GE(found.size(), 2U);
  // The room is its own image by half a turn.
  EXPECT_NEAR(found[0].score, found[1].score, 0.5);
  for (std::size_t i = 2; i < found.size(); ++i) EXPECT_LT(found[i].score, found[0].score - 3);
  EXPECT_EQ(e.dut->Rivals(2).size(), 2U);
  EXPECT_GE(e.dut->CountHeld(), 2);
  EXPECT_EQ(e.dut->changed(), e.now);
}

TEST(PlaceEvidence, OneWallIsHeldByNothing) {
  Evidence e;
  e.DriveTo(4);
  e.Hear(1, 3, 0, 0, 3);
  e.dut->Search();
  EXPECT_EQ(e.dut->CountHeld(), 0);
}

TEST(PlaceEvidence, AWiderMarginLeavesNoFewerPlaces) {
  Evidence e;
  e.DriveTo(4);
  e.Hear(1, 3, 0, 0, 3);
  e.Hear(2, 0, 2, -90, 2);
  e.Hear(3, 6, 2, 90, 2);
  EXPECT_GE(e.dut->SearchWithin(16).size(), e.dut->Search().size());
}

TEST(PlaceEvidence, BeginForgetsEverything) {
  Evidence e;
  e.DriveTo(4);
  e.Hear(1, 3, 0, 0, 3);
  e.Hear(2, 0, 2, -90, 2);
  e.dut->Search();
  e.dut->Begin(e.now);
  EXPECT_TRUE(e.dut->found().empty());
  EXPECT_TRUE(e.dut->log().empty());
}

}  // namespace
}  // namespace priamos::planner
