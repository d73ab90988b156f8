#include "planner/core/map/door_landmark.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

int CountVisible(const Landmark& landmark, Side side, const Eigen::Vector2d& viewer) {
  return static_cast<int>(std::count_if(landmark.edges.begin(), landmark.edges.end(), [&](const auto& edge) {
    return edge.side == side && IsVisible(edge, viewer);
  }));
}

TEST(DoorLandmark, HasThreeUprightEdgesPerSideAndThreeAbove) {
  const Landmark dut = MakeDoorLandmark(DoorPlan{});
  EXPECT_EQ(CountVisible(dut, Side::kLeft, {-2.5, 0}), 3);
  EXPECT_EQ(CountVisible(dut, Side::kRight, {-2.5, 0}), 3);
  EXPECT_EQ(CountVisible(dut, Side::kBoth, {-2.5, 0}), 3);
  EXPECT_LE(dut.edges.size(), 24u);
}

TEST(DoorLandmark, EdgesLieAtTheirTrueDepths) {
  const Landmark dut = MakeDoorLandmark(DoorPlan{});
  EXPECT_NEAR((dut.edges[0].from - Eigen::Vector3d(-0.085, 0.51, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((dut.edges[0].to - Eigen::Vector3d(-0.085, 0.51, 2.06)).norm(), 0, 1e-12);
  EXPECT_NEAR((dut.edges[2].from - Eigen::Vector3d(-0.085, 0.45, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((dut.edges[4].to - Eigen::Vector3d(0.03, 0.45, 2.0)).norm(), 0, 1e-12);
}

TEST(DoorLandmark, LeftAndRightAreMirrored) {
  const Landmark dut = MakeDoorLandmark(DoorPlan{});
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_EQ(dut.edges[i].side, Side::kLeft);
    EXPECT_EQ(dut.edges[i + 1].side, Side::kRight);
    EXPECT_GT(dut.edges[i].from.y(), 0);
    EXPECT_DOUBLE_EQ(dut.edges[i].from.y(), -dut.edges[i + 1].from.y());
    for (double azimuth_deg = -179; azimuth_deg < 180; azimuth_deg += 1) {
      const double c = std::cos(Radians(azimuth_deg)), s = std::sin(Radians(azimuth_deg));
      EXPECT_EQ(IsVisible(dut.edges[i], {c, s}), IsVisible(dut.edges[i + 1], {c, -s})) << azimuth_deg;
    }
  }
}

TEST(DoorLandmark, WithoutANoteOfGreysNoEdgeTellsAny) {
  for (const LandmarkEdge& edge : MakeDoorLandmark(DoorPlan{}).edges) EXPECT_FALSE(edge.grey_ratio);
}

TEST(DoorLandmark, BesideTheOuterEdgesOfTheFrameTheBrighterOneIsOnItsSide) {
  DoorPlan door;
  door.frame_over_wall = 2;
  door.behind_id = 9;
  for (const Landmark& dut : {MakeDoorLandmark(door), MakeDoorLandmarkFromBehind(door)}) {
    EXPECT_NEAR(dut.edges[0].grey_ratio.value(), std::log(2), 1e-12) << "right of the left one, upwards";
    EXPECT_NEAR(dut.edges[1].grey_ratio.value(), -std::log(2), 1e-12);
    const LandmarkEdge& lintel = dut.edges[6];
    EXPECT_GT(lintel.from.z(), door.opening_height_m) << "the outer one";
    EXPECT_GT(lintel.to.y(), lintel.from.y()) << "to the left, the wall on its right, above";
    EXPECT_NEAR(lintel.grey_ratio.value(), -std::log(2), 1e-12);
    for (const std::size_t i : {2, 3, 4, 5, 7, 8}) EXPECT_FALSE(dut.edges[i].grey_ratio) << i;
  }
}

TEST(DoorLandmark, NothingIsVisibleFromBehind) {
  const Landmark dut = MakeDoorLandmark(DoorPlan{});
  for (const Side side : {Side::kBoth, Side::kLeft, Side::kRight})
    EXPECT_EQ(CountVisible(dut, side, {2, 0.1}), 0);
}

TEST(DoorLandmark, DepthOfAJambIsHiddenForAViewerOnItsOwnSide) {
  const Landmark dut = MakeDoorLandmark(DoorPlan{});
  EXPECT_EQ(CountVisible(dut, Side::kLeft, {-2.5, 0.6}), 2);
  EXPECT_EQ(CountVisible(dut, Side::kRight, {-2.5, 0.6}), 3);
  EXPECT_EQ(CountVisible(dut, Side::kRight, {-2.5, -0.6}), 2);
}

/// Whether the sight line from `viewer` to `target` misses the right jamb, taken as a box.
bool MissesRightJamb(const Eigen::Vector2d& viewer, const Eigen::Vector2d& target) {
  for (double part = 0; part < 1; part += 1e-4) {
    const Eigen::Vector2d p = viewer + part * (target - viewer);
    if (p.x() > -0.085 && p.x() < 0.07 && p.y() < -0.45) return false;
  }
  return true;
}

TEST(DoorLandmark, WhoIsInTheSectorOfTheStopReallySeesIt) {
  const Landmark dut = MakeDoorLandmark(DoorPlan{});
  const Eigen::Vector2d stop = dut.edges[4].from.head<2>();
  for (double azimuth_deg = 91; azimuth_deg < 269; azimuth_deg += 0.5) {
    const Eigen::Vector2d viewer =
        2.5 * Eigen::Vector2d(std::cos(Radians(azimuth_deg)), std::sin(Radians(azimuth_deg)));
    if (!IsVisible(dut.edges[4], viewer)) continue;
    EXPECT_LT(viewer.y(), 0.45) << azimuth_deg;
    EXPECT_TRUE(MissesRightJamb(viewer, stop)) << azimuth_deg;
  }
}

}  // namespace
}  // namespace priamos::planner
