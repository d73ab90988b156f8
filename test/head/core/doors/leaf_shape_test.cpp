#include "head/core/doors/leaf_shape.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

const DoorPlan kDoor;
const Eigen::Vector3d kViewer{-2.5, 0, 1.3};

LeafAt Leaf(const char* hinge, double open_deg) {
  return LeafAt(kDoor, hinge, Radians(open_deg), 0.04);
}

TEST(LeafAt, ItsFreeEndSwingsIntoTheFarRoomAndRightIsTheMirrorImageOfLeft) {
  for (const double deg : {10.0, 45.0, 90.0}) {
    const auto left = Leaf("left", deg).FreeEnds(), right = Leaf("right", deg).FreeEnds();
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(left[i].x(), right[i].x(), 1e-9);
      EXPECT_NEAR(left[i].y(), -right[i].y(), 1e-9);
      EXPECT_GT(left[i].x(), kDoor.StopX());
    }
  }
  EXPECT_LT(Leaf("left", 10).FreeEnds()[0].y(), -0.4);
  EXPECT_GT(Leaf("left", 90).FreeEnds()[0].y(), 0.4);
}

TEST(LeafAt, OfItsFacesOnlyTheOneTowardsTheViewerShowsAnUpperEdge) {
  for (const char* hinge : {"left", "right"}) {
    const auto upper = Leaf(hinge, 45).UpperEdges(kViewer.head<2>());
    ASSERT_EQ(upper.size(), 1u);
    EXPECT_TRUE(upper[0].from.head<2>().isApprox(Leaf(hinge, 45).FreeEnds()[0]));
    EXPECT_EQ(Leaf(hinge, 45).FreeEdges(kViewer.head<2>()).size(), 1u) << "its end looks away";
    const auto beyond = Leaf(hinge, 120).FreeEdges(kViewer.head<2>());
    ASSERT_EQ(beyond.size(), 1u) << "its other face";
    EXPECT_TRUE(beyond[0].from.head<2>().isApprox(Leaf(hinge, 120).FreeEnds()[1]));
  }
}

TEST(LeafAt, ItHidesWhatIsBehindItAndNothingElse) {
  const LeafAt leaf = Leaf("left", 45);
  EXPECT_TRUE(leaf.Hides(kViewer.head<2>(), {3, 0.3}, 0.1));
  EXPECT_FALSE(leaf.Hides(kViewer.head<2>(), {3, -0.8}, 0.1));
  EXPECT_FALSE(leaf.Hides(kViewer.head<2>(), {0.2, 0.1}, 0.1)) << "before it";
}

TEST(ThroughOpening, WhatIsBesideTheDoorIsCutOff) {
  const auto level = ThroughOpening(kDoor, kViewer, {{2, -3, 1.3}, {2, 3, 1.3}});
  ASSERT_TRUE(level);
  const double reach = 0.45 * 4.5 / (kDoor.StopX() + 2.5);
  EXPECT_NEAR(level->from.y(), -reach, 1e-9);
  EXPECT_NEAR(level->to.y(), reach, 1e-9);
  const auto upright = ThroughOpening(kDoor, kViewer, {{2, 0, 4}, {2, 0, 0}});
  ASSERT_TRUE(upright);
  EXPECT_NEAR(upright->from.z(), 1.3 + 0.7 * 4.5 / (kDoor.StopX() + 2.5), 1e-9);
  EXPECT_NEAR(upright->to.z(), 0, 1e-9);
  EXPECT_FALSE(ThroughOpening(kDoor, kViewer, {{2, 1.5, 0}, {2, 1.5, 2}}));
}

}  // namespace
}  // namespace priamos::head
