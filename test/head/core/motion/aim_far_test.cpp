#include "head/core/motion/aim_far.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

HeadModel Calibrated() {
  HeadModel model;
  for (LensTable& lens : model.lenses)
    lens = LensTable({250}, {1600}, {{890, {383.5, 287.5}, -0.05, 0, 0.02}});
  return model;
}

const HeadSetting kSetting{0, -0.09, {-0.02, 0.02}, {250, 250}, {1600, 1600}};

/// The direction of a place as the pan axis sees it.
UprightTarget At(double bearing_deg, double distance_m = 4) {
  return {{0.25 + distance_m * std::cos(Radians(bearing_deg)), distance_m * std::sin(Radians(bearing_deg))},
          0.5,
          2};
}

TEST(AimFarTest, StraightAheadWhereThatShowsThemAll) {
  EXPECT_EQ(AimFar(Calibrated(), kSetting, std::vector{At(-8), At(0), At(10)}), 0);
  EXPECT_EQ(AimFar(Calibrated(), kSetting, {}), 0);
}

TEST(AimFarTest, TurnsJustAsFarAsTheMostNeed) {
  const double dut = AimFar(Calibrated(), kSetting, std::vector{At(-30), At(12), At(28), At(32)});
  EXPECT_GT(dut, Radians(8));
  EXPECT_LT(dut, Radians(25));
}

TEST(AimFarTest, WhatIsBehindIsNoReason) {
  EXPECT_LT(AimFar(Calibrated(), kSetting, std::vector{At(170), At(175), At(-25)}), 0);
}

}  // namespace
}  // namespace priamos::head
