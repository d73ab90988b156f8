#include "robot/core/pose/slip_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace priamos::robot {
namespace {

constexpr double kSlip = 4e-6, kFixes = 5e-7, kApart_m = 0.25;

/// What the scale says after `n` pairs of fixes on wheels whose slip has `factor` times the variance.
double After(int n, double factor, double turn_rad_per_m, unsigned seed) {
  SlipScale scale;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, std::sqrt(factor * kSlip + kFixes));
  for (int i = 0; i < n; ++i) scale.Add(normal(random) + turn_rad_per_m * kApart_m, kSlip, kFixes, kApart_m);
  return scale.factor();
}

TEST(SlipScale, WithoutFixesTheOdometrysNoiseCounts) {
  EXPECT_NEAR(SlipScale().factor(), 1, 0.06);
}

TEST(SlipScale, FixesTellHowMuchTheWheelsSlip) {
  for (const double factor : {0.3, 1.0, 6.25}) {
    double sum = 0;
    for (unsigned seed = 1; seed <= 50; ++seed) sum += After(12, factor, 0, seed) / 50;
    EXPECT_GT(sum, 0.7 * factor) << factor;
    EXPECT_LT(sum, 1.5 * factor) << factor;
  }
}

TEST(SlipScale, AConstantTurnIsNoSlip) {
  double sum = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) sum += After(12, 1, 0.006, seed) / 50;
  EXPECT_LT(sum, 1.6);
}

TEST(SlipScale, WhatIsNoNumberTellsNothing) {
  SlipScale scale;
  scale.Add(std::nan(""), kSlip, kFixes, kApart_m);
  scale.Add(0.1, 0, 0, kApart_m);
  EXPECT_NEAR(scale.factor(), 1, 0.06);
}

}  // namespace
}  // namespace priamos::robot
