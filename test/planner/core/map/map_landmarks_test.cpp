#include "planner/core/map/map_landmarks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/core/map/cupboard_landmark.hpp"
#include "planner/core/map/door_landmark.hpp"

namespace priamos::planner {
namespace {

DoorPlan DoorWithLeaf(const std::string& hinge, double open_deg) {
  DoorPlan door;
  door.leaf = hinge;
  door.leaf_open_deg = open_deg;
  return door;
}

std::vector<LandmarkEdge> LeafOf(const Landmark& landmark) {
  std::vector<LandmarkEdge> leaf;
  std::copy_if(landmark.edges.begin(), landmark.edges.end(), std::back_inserter(leaf),
               [](const LandmarkEdge& e) { return e.side == Side::kMovable; });
  return leaf;
}

TEST(DoorLeaf, AnUnknownLeafAddsNothing) {
  EXPECT_EQ(MakeDoorLandmark(DoorPlan{}).edges.size(), 9u);
  EXPECT_TRUE(LeafOf(MakeDoorLandmark(DoorWithLeaf("none", 0))).empty());
}

TEST(DoorLeaf, AClosedLeafLiesInItsRebateAndShowsNoEdge) {
  EXPECT_TRUE(LeafOf(MakeDoorLandmark(DoorWithLeaf("left", 0))).empty());
}

TEST(DoorLeaf, AnOpenLeafShowsItsFreeEndWhereItIs) {
  for (const double open_deg : {30.0, 45.0, 60.0}) {
    const DoorPlan door = DoorWithLeaf("left", open_deg);
    const auto leaf = LeafOf(MakeDoorLandmark(door));
    ASSERT_FALSE(leaf.empty()) << open_deg;
    // Free end of a leaf that turns about a pin behind the left jamb.
    const double angle = Radians(open_deg), length = door.opening_width_m;
    const Eigen::Vector2d about(door.BackX() + length * std::sin(angle),
                                door.opening_width_m / 2 - length * std::cos(angle));
    const double nearest =
        std::accumulate(leaf.begin(), leaf.end(), 1e9, [&](double d, const LandmarkEdge& e) {
          return (e.to - e.from).head<2>().norm() < 1e-9 ? std::min(d, (e.from.head<2>() - about).norm()) : d;
        });
    EXPECT_LT(nearest, 0.09) << open_deg;
  }
}

TEST(DoorLeaf, LeftAndRightHingesAreMirrored) {
  const auto left = LeafOf(MakeDoorLandmark(DoorWithLeaf("left", 50)));
  const auto right = LeafOf(MakeDoorLandmark(DoorWithLeaf("right", 50)));
  ASSERT_EQ(left.size(), right.size());
  for (const LandmarkEdge& l : left) {
    EXPECT_TRUE(std::any_of(right.begin(), right.end(), [&](const LandmarkEdge& r) {
      const auto is_mirrored = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return (a - Eigen::Vector3d(b.x(), -b.y(), b.z())).norm() < 1e-9;
      };
      return (is_mirrored(l.from, r.from) && is_mirrored(l.to, r.to)) ||
             (is_mirrored(l.from, r.to) && is_mirrored(l.to, r.from));
    }));
  }
}

TEST(DoorLeaf, AtAnyAngleTheModelFitsTheMessage) {
  for (double open_deg = 0; open_deg <= 175; open_deg += 5) {
    const Landmark dut = MakeDoorLandmark(DoorWithLeaf("right", open_deg));
    EXPECT_LE(dut.edges.size(), std::size_t(kMaxLandmarkEdges)) << open_deg;
    for (const LandmarkEdge& e : dut.edges) {
      for (const Eigen::Vector3d& p : {e.from, e.to}) {
        EXPECT_LE(p.head<2>().cwiseAbs().maxCoeff(), 2.5) << open_deg;
        EXPECT_GE(p.z(), 0) << open_deg;
      }
    }
  }
}

TEST(CupboardLandmark, ItsFrontHasTwoUprightsATopAPlinthAndBothSidesOfTheGap) {
  const CupboardPlan plan{7, "files", 4, 3, 90};
  const Landmark dut = MakeCupboardLandmark(plan);
  EXPECT_EQ(dut.id, 7);
  EXPECT_NEAR(dut.map_from_landmark.yaw, kPi / 2, 1e-12);
  const auto seen = std::count_if(dut.edges.begin(), dut.edges.end(), [](const LandmarkEdge& e) {
    return IsVisible(e, {-2.5, 0});
  });
  EXPECT_EQ(seen, 6);
  EXPECT_LE(dut.edges.size(), std::size_t(kMaxLandmarkEdges));
  for (const LandmarkEdge& e : dut.edges) EXPECT_GE(std::min(e.from.x(), e.to.x()), -1e-12);
}

TEST(CupboardLandmark, ThreeDoorsHaveTwoGapsAtTheirPlaces) {
  CupboardPlan plan;
  plan.n_doors = 3;
  plan.width_m = 1.2;
  plan.gap_m = 0.01;
  int gaps = 0;
  for (const LandmarkEdge& e : MakeCupboardLandmark(plan).edges) {
    if (e.side != Side::kBoth || std::abs(e.from.y() - e.to.y()) > 1e-9 || std::abs(e.from.x()) > 1e-9)
      continue;
    EXPECT_NEAR(std::abs(std::abs(e.from.y()) - 0.2), 0.005, 1e-9);
    ++gaps;
  }
  EXPECT_EQ(gaps, 4);
}

TEST(CupboardLandmark, OnlyItsPlinthTellsGreysWhereTheMapDoes) {
  CupboardPlan plan;
  for (const LandmarkEdge& e : MakeCupboardLandmark(plan).edges) EXPECT_FALSE(e.grey_ratio);
  plan.plinth_over_front = 0.5;
  int told = 0;
  for (const LandmarkEdge& e : MakeCupboardLandmark(plan).edges) {
    if (!e.grey_ratio) continue;
    ++told;
    EXPECT_EQ(e.from.z(), plan.plinth_m);
    EXPECT_GT(e.to.y(), e.from.y()) << "to the left, the doors on its right, above";
    EXPECT_NEAR(*e.grey_ratio, std::log(2), 1e-12);
  }
  EXPECT_EQ(told, 1);
}

TEST(MapLandmarks, FindsDoorsAndCupboardsByNumber) {
  GroundPlan plan;
  plan.doors.emplace_back().id = 3;
  plan.cupboards.emplace_back().id = 4;
  EXPECT_EQ(MakeLandmark(plan, 3)->id, 3);
  EXPECT_EQ(MakeLandmark(plan, 4)->id, 4);
  EXPECT_FALSE(MakeLandmark(plan, 5));
}

}  // namespace
}  // namespace priamos::planner
