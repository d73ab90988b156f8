#include "world/core/base/contact.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

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

/// Gap by walking over the outlines of footprint and solids in steps of `spacing`, which bounds its error.
double BruteForceGap(const Pose2& pose, const Body& body, const std::vector<Solid>& solids, double spacing) {
  double nearest = 10;
  const Rectangle footprint{pose, body.size_m / 2};
  for (const auto& solid : solids) {
    const Rectangle other{solid.map_from_solid, solid.size_m / 2};
    nearest = std::min({nearest, Distance(other, pose.translation()),
                        Distance(footprint, solid.map_from_solid.translation())});
    const auto corners = footprint.Corners();
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d delta = corners[(i + 1) % 4] - corners[i];
      const int n = static_cast<int>(delta.norm() / spacing) + 1;
      for (int k = 0; k <= n; ++k) nearest = std::min(nearest, Distance(other, corners[i] + delta * k / n));
    }
  }
  return nearest;
}

RC_GTEST_PROP(ClearanceProperty, GapEqualsBruteForce, ()) {
  const auto value = [](int low, int high) { return *rc::gen::inRange(low, high) / 100.0; };
  std::vector<Solid> solids;
  for (int i = 0; i < 5; ++i)
    solids.push_back(
        Box({value(-400, 400), value(-400, 400), value(-314, 314)}, {value(2, 200), value(2, 200)}));
  const Pose2 pose{value(-200, 200), value(-200, 200), value(-314, 314)};
  const double gap = Clearance(Body{}, solids).Gap(pose, 10);
  const double expected = BruteForceGap(pose, Body{}, solids, 0.004);
  RC_ASSERT(gap <= expected + 1e-9);
  RC_ASSERT(gap >= expected - 0.004);
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
