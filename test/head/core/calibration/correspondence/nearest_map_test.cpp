#include "head/core/calibration/correspondence/nearest_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::Between;

constexpr double kCell_px = 16, kMargin_px = 48;

std::vector<DetectedDisc> DiscsAt(const std::vector<Vector2d>& places) {
  std::vector<DetectedDisc> discs;
  for (const Vector2d& at : places) discs.emplace_back().ellipse.centre_px = at;
  return discs;
}

std::vector<DetectedDisc> AnyDiscs() {
  std::vector<Vector2d> places;
  for (int i = *rc::gen::inRange(1, 20); i > 0; --i) places.emplace_back(Between(10, 700), Between(10, 500));
  return DiscsAt(places);
}

double Distance(const std::vector<DetectedDisc>& discs, int i, const Vector2d& px) {
  return (discs[i].ellipse.centre_px - px).norm();
}

RC_GTEST_PROP(NearestMap, NoDetectionIsNearerByMoreThanACell, ()) {
  const auto discs = AnyDiscs();
  const NearestMap dut(discs);
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const auto& d : discs) {
    low = low.cwiseMin(d.ellipse.centre_px);
    high = high.cwiseMax(d.ellipse.centre_px);
  }
  const Vector2d px(Between(low.x(), high.x()), Between(low.y(), high.y()));
  const int found = dut(px);
  RC_ASSERT(found >= 0 && found < static_cast<int>(discs.size()));
  // The candidate is nearest to the middle of the cell, half a diagonal away at most.
  for (int i = 0; i < static_cast<int>(discs.size()); ++i)
    RC_ASSERT(Distance(discs, found, px) <= Distance(discs, i, px) + kCell_px * std::sqrt(2) + 1e-9);
}

RC_GTEST_PROP(NearestMap, ADetectionThatStandsAloneIsFoundAtItsPlace, ()) {
  const auto discs = AnyDiscs();
  const NearestMap dut(discs);
  for (int i = 0; i < static_cast<int>(discs.size()); ++i) {
    bool alone = true;
    for (int k = 0; k < static_cast<int>(discs.size()); ++k)
      alone &= k == i || Distance(discs, k, discs[i].ellipse.centre_px) > kCell_px * std::sqrt(2);
    RC_ASSERT(!alone || dut(discs[i].ellipse.centre_px) == i);
  }
}

TEST(NearestMap, HalvesTheSpaceBetweenTwoDetections) {
  const NearestMap dut(DiscsAt({{100, 100}, {260, 100}}));
  EXPECT_EQ(dut({110, 100}), 0);
  EXPECT_EQ(dut({170, 100}), 0);
  EXPECT_EQ(dut({190, 100}), 1);
  EXPECT_EQ(dut({250, 100}), 1);
}

TEST(NearestMap, FarFromAllDetectionsThereIsNone) {
  const NearestMap dut(DiscsAt({{100, 100}, {300, 200}}));
  EXPECT_EQ(dut({100 - kMargin_px + 1, 100}), 0);
  EXPECT_EQ(dut({100 - kMargin_px - 1, 100}), -1);
  EXPECT_EQ(dut({100, 100 - kMargin_px - 1}), -1);
  EXPECT_EQ(dut({300 + kMargin_px - 1, 200}), 1);
  EXPECT_EQ(dut({300 + kMargin_px + kCell_px + 1, 200}), -1);
  EXPECT_EQ(dut({300, 200 + kMargin_px + kCell_px + 1}), -1);
}

TEST(NearestMap, OneDetectionIsEnough) {
  const NearestMap dut(DiscsAt({{50, 60}}));
  EXPECT_EQ(dut({50, 60}), 0);
  EXPECT_EQ(dut({80, 90}), 0);
  EXPECT_EQ(dut({150, 60}), -1);
}

TEST(NearestMap, NumbersThatAreNoneAreNearNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const NearestMap dut(DiscsAt({{50, 60}}));
  EXPECT_EQ(dut({nan, 60}), -1);
  EXPECT_EQ(dut({50, nan}), -1);
}

}  // namespace
}  // namespace priamos::head
