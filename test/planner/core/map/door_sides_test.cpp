#include "planner/core/map/door_sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/core/map/door_landmark.hpp"
#include "planner/core/map/map_landmarks.hpp"

namespace priamos::planner {
namespace {

DoorPlan ADoor() {
  DoorPlan door;
  door.id = 3;
  door.behind_id = 103;
  door.x_m = 6;
  door.y_m = 2;
  door.yaw_deg = 30;
  door.leaf = "left";
  return door;
}

TEST(DoorSides, FromBehindTheDoorPointsBackAndHasItsOtherNumber) {
  const DoorPlan behind = FromBehind(ADoor());
  EXPECT_EQ(behind.id, 103);
  EXPECT_EQ(behind.behind_id, 3);
  EXPECT_NEAR(WrapAngle(Radians(behind.yaw_deg - 210)), 0, 1e-12);
  EXPECT_EQ(behind.FrontX(), -ADoor().BackX()) << "flush with the wall";
  EXPECT_EQ(behind.leaf, "unknown");
}

TEST(DoorSides, OnlyADoorWithANumberBehindHasTwoSides) {
  GroundPlan plan;
  plan.doors = {ADoor(), DoorPlan{}};
  const auto sides = DoorSides(plan);
  ASSERT_EQ(sides.size(), 3u);
  EXPECT_EQ(sides[1].id, 103);
}

/// Where an end of an edge is on the map.
Eigen::Vector2d OnMap(const Landmark& landmark, const Eigen::Vector3d& point) {
  return landmark.map_from_landmark * Eigen::Vector2d(point.head<2>());
}

TEST(DoorSides, BothLandmarksDescribeOneDoor) {
  const DoorPlan door = ADoor();
  const Landmark front = MakeDoorLandmark(door), behind = MakeDoorLandmarkFromBehind(door);
  EXPECT_EQ(behind.id, 103);
  // The arris of the stop is one and the same, seen from both sides, and what is left in one is right in the
  // other.
  const auto of_stop = [&](const LandmarkEdge& e) { return std::abs(e.from.x() - door.StopX()) < 1e-9; };
  const auto seen = std::find_if(front.edges.begin(), front.edges.end(), of_stop);
  ASSERT_NE(seen, front.edges.end());
  const auto same = std::find_if(behind.edges.begin(), behind.edges.end(), [&](const LandmarkEdge& e) {
    return (OnMap(behind, e.from) - OnMap(front, seen->from)).norm() < 1e-9 && e.to.z() == seen->to.z();
  });
  ASSERT_NE(same, behind.edges.end());
  EXPECT_EQ(seen->side, Side::kLeft);
  EXPECT_EQ(same->side, Side::kRight);
}

TEST(DoorSides, FromBehindThreeEdgesPerSideAreSeenFromThereAndNoneFromTheFront) {
  const Landmark dut = MakeDoorLandmarkFromBehind(ADoor());
  for (const Side side : {Side::kLeft, Side::kRight, Side::kBoth}) {
    const auto seen = [&](const Eigen::Vector2d& viewer) {
      return std::count_if(dut.edges.begin(), dut.edges.end(),
                           [&](const LandmarkEdge& e) { return e.side == side && IsVisible(e, viewer); });
    };
    EXPECT_EQ(seen({-2.5, 0}), 3);
    EXPECT_EQ(seen({2.5, 0}), 0);
  }
}

TEST(DoorSides, TheStopHidesBehindItsOwnRebate) {
  const Landmark dut = MakeDoorLandmarkFromBehind(ADoor());
  const auto left = [&](const Eigen::Vector2d& viewer) {
    return std::count_if(dut.edges.begin(), dut.edges.end(), [&](const LandmarkEdge& e) {
      return e.side == Side::kLeft && IsVisible(e, viewer);
    });
  };
  EXPECT_EQ(left({-2.5, 1.5}), 1) << "the edge of the frame alone";
  EXPECT_EQ(left({-2.5, -1.5}), 3);
}

TEST(DoorSides, TheLandmarkBehindIsFoundByItsNumber) {
  GroundPlan plan;
  plan.doors = {ADoor(), DoorPlan{}};
  EXPECT_EQ(MakeLandmark(plan, 103)->edges.size(), MakeDoorLandmarkFromBehind(ADoor()).edges.size());
  EXPECT_FALSE(MakeLandmark(plan, 0)) << "a door without one behind";
}

}  // namespace
}  // namespace priamos::planner
