#include "planner/core/missions/passage_decision.hpp"

#include <gtest/gtest.h>

#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

/// The shipped door with another width.
DoorPlan DoorOf(double width_m) {
  DoorPlan door = ShippedPlan().doors[0];
  door.opening_width_m = width_m;
  return door;
}

Eigen::Matrix3d CovarianceOf(double across_m, double heading_deg) {
  const double heading = Radians(heading_deg);
  return Eigen::Vector3d(1e-4, across_m * across_m, heading * heading).asDiagonal();
}

/// Sigmas of the pose as they are at 0.85 m when the last look was at 1.3 m, and after one from 0.7 m.
const Eigen::Matrix3d kAsLongAgo = CovarianceOf(0.0049, 0.35), kAfterALook = CovarianceOf(0.0035, 0.05);

TEST(PassageDecision, ABaseThatFitsEntersAtTheLastPlaceFromWhichItCouldGoBack) {
  PassageDecision dut({}, Footprint{});
  dut.Begin();
  EXPECT_EQ(dut.Next(DoorOf(0.90), kAfterALook, 0.86), PassageStep::kWait);
  EXPECT_EQ(dut.Next(DoorOf(0.90), kAfterALook, 0.84), PassageStep::kEnter);
  EXPECT_EQ(dut.Next(DoorOf(0.90), CovarianceOf(0.1, 5), 0.5), PassageStep::kWait) << "it is in the door";
}

TEST(PassageDecision, ATightDoorIsApproachedSlowlyUntilALookFromNearDecides) {
  PassageDecision dut({}, Footprint{});
  dut.Begin();
  const DoorPlan door = DoorOf(0.82);
  EXPECT_EQ(dut.Next(door, kAsLongAgo, 0.84), PassageStep::kGoBack) << "no look from near would do";
  dut.Begin();
  const Eigen::Matrix3d middling = CovarianceOf(0.0035, 0.25);
  EXPECT_EQ(dut.Next(door, middling, 0.84), PassageStep::kSlowDown);
  EXPECT_EQ(dut.Next(door, middling, 0.78), PassageStep::kWait);
  EXPECT_EQ(dut.Next(door, kAfterALook, 0.72), PassageStep::kEnter);
}

TEST(PassageDecision, ASlowBaseGoesBackWhenNoLookCame) {
  PassageDecision dut({}, Footprint{});
  dut.Begin();
  const DoorPlan door = DoorOf(0.82);
  const Eigen::Matrix3d middling = CovarianceOf(0.0035, 0.25);
  EXPECT_EQ(dut.Next(door, middling, 0.84), PassageStep::kSlowDown);
  EXPECT_EQ(dut.Next(door, kAsLongAgo, 0.70), PassageStep::kWait);
  EXPECT_EQ(dut.Next(door, kAsLongAgo, 0.67), PassageStep::kGoBack);
  EXPECT_EQ(dut.Next(door, kAsLongAgo, 0.66), PassageStep::kWait) << "said once";
}

TEST(PassageDecision, BeyondTheLastLookTheWheelsAdd) {
  const PassageDecision dut({}, Footprint{});
  const auto near = dut.Expect(DoorOf(0.82), kAfterALook, 3.0, 0.5);
  const auto far = dut.Expect(DoorOf(0.82), kAfterALook, 3.0, 1.5);
  EXPECT_GT(near.gap_m, far.gap_m);
  EXPECT_NEAR(dut.Expect(DoorOf(0.82), kAfterALook, 3.0).gap_m,
              dut.Expect(DoorOf(0.82), kAfterALook, 3.0, PassageRules{}.last_look_m).gap_m, 1e-12);
}

}  // namespace
}  // namespace priamos::planner
