#include "planner/core/missions/leaf_belief.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

LeafSighting Seen(const std::string& hinge, double deg, double log_odds = 6) {
  return {Time{}, 1, hinge, Radians(deg), Radians(0.7), log_odds};
}

TEST(LeafBelief, OneLookIsNotEnough) {
  LeafBelief dut;
  EXPECT_FALSE(dut.Estimate());
  dut.Add(Seen("left", 45, 20));
  EXPECT_FALSE(dut.Estimate());
}

TEST(LeafBelief, TwoLooksThatAgreeAreJoined) {
  LeafBelief dut;
  dut.Add(Seen("left", 45));
  dut.Add(Seen("left", 46));
  const auto leaf = dut.Estimate();
  ASSERT_TRUE(leaf);
  EXPECT_EQ(leaf->hinge, "left");
  EXPECT_NEAR(Degrees(leaf->open_rad), 45.5, 1e-6);
  EXPECT_NEAR(Degrees(leaf->sigma_rad), 0.7, 1e-6) << "the hinges' error is common to both";
}

TEST(LeafBelief, AnOutlierDoesNotMoveTheAngleButCountsAgainstIt) {
  LeafBelief dut;
  dut.Add(Seen("left", 45));
  dut.Add(Seen("left", 80, 8));
  dut.Add(Seen("left", 45));
  EXPECT_FALSE(dut.Estimate());
  dut.Add(Seen("left", 45));
  ASSERT_TRUE(dut.Estimate());
  EXPECT_NEAR(Degrees(dut.Estimate()->open_rad), 45, 1e-6);
}

TEST(LeafBelief, TheSameAngleAtTheOtherSideIsAnotherLeaf) {
  LeafBelief dut;
  dut.Add(Seen("left", 57));
  dut.Add(Seen("right", 57));
  EXPECT_FALSE(dut.Estimate());
}

TEST(LeafBelief, LooksThatShowNoLeafCountAgainstIt) {
  LeafBelief dut;
  dut.Add(Seen("left", 45, 3.4));
  dut.Add(Seen("left", 45, 3.4));
  EXPECT_TRUE(dut.Estimate());
  dut.Add(Seen("", 0, 0));
  EXPECT_FALSE(dut.Estimate());
  dut.Reset();
  EXPECT_FALSE(dut.Estimate());
}

}  // namespace
}  // namespace priamos::planner
