#include "world/core/contact.hpp"

#include <gtest/gtest.h>

namespace priamos::world {
namespace {

Solid Box(Pose2 pose, Eigen::Vector2d size, double low = 0, double high = 2) {
  return {"box", pose, size, low, high, "wall"};
}

TEST(ClearanceTest, GapIsMeasuredFromTheRectangularFootprint) {
  // Door of 0.90 m: 6 cm on each side of the 0.78 m wide robot, where the circle around it would not fit.
  const Clearance dut(Body{}, {Box({0, 0.95, 0}, {0.2, 1.0}), Box({0, -0.95, 0}, {0.2, 1.0})});
  EXPECT_NEAR(dut.Gap({0, 0, 0}, 10), 0.06, 1e-12);
  EXPECT_NEAR(dut.Gap({0, 0.02, 0}, 10), 0.04, 1e-12);
}

TEST(ClearanceTest, LimitCapsTheGap) {
  const Clearance dut(Body{}, {Box({9, 0, 0}, {0.2, 1.0})});
  EXPECT_EQ(dut.Gap({0, 0, 0}, 2), 2);
}

TEST(ClearanceTest, ThresholdAndLintelAreOutOfReach) {
  const Clearance dut(Body{}, {Box({0, 0, 0}, {0.2, 1}, 0, 0.015), Box({0, 0, 0}, {0.2, 1}, 2, 2.06)});
  EXPECT_EQ(dut.Gap({0, 0, 0}, 10), 10);
}

TEST(ClearanceTest, TableTopAtRobotHeightIsNot) {
  const Clearance dut(Body{}, {Box({0, 0, 0}, {0.2, 1}, 0.7, 0.75)});
  EXPECT_EQ(dut.Gap({0, 0, 0}, 10), 0);
}

TEST(ClearanceTest, FreePartEndsAtTheObstacle) {
  const Clearance dut(Body{}, {Box({1.0, 0, 0}, {0.1, 1})});  // front face at 0.95, robot front at 0.475
  EXPECT_EQ(dut.FreePart({0, 0, 0}, {0.4, 0, 0}), 1);
  EXPECT_NEAR(dut.FreePart({0, 0, 0}, {0.95, 0, 0}), 0.5, 0.001);
}

TEST(ContactCounterTest, ScrapingIsOneTouch) {
  ContactCounter dut(0.0005, 0.01);
  for (const double gap : {0.1, 0.0, 0.002, 0.0, 0.005, 0.0001}) dut.Update(gap);
  EXPECT_EQ(dut.contacts(), 1);
}

TEST(ContactCounterTest, TouchingAgainAfterLeavingIsASecondTouch) {
  ContactCounter dut(0.0005, 0.01);
  for (const double gap : {0.1, 0.0, 0.02, 0.0}) dut.Update(gap);
  EXPECT_EQ(dut.contacts(), 2);
}

TEST(ContactCounterTest, KeepsTheSmallestGap) {
  ContactCounter dut(0.0005, 0.01);
  for (const double gap : {0.1, 0.03, 0.2}) dut.Update(gap);
  EXPECT_EQ(dut.min_gap_m(), 0.03);
  EXPECT_EQ(dut.contacts(), 0);
}

}  // namespace
}  // namespace priamos::world
