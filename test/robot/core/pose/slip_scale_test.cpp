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
  for (int i = 0; i < n; ++i)
    scale.AddTurn({normal(random) + turn_rad_per_m * kApart_m, kSlip, kFixes, kApart_m});
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

TEST(SlipScale, WhatGoesAsideTellsItAsWell) {
  constexpr double kAside = 2.6e-6, kSeen = 2e-6;
  double straight = 0, sideways = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SlipScale turns_only, both;
    std::mt19937 random(seed);
    std::normal_distribution<double> turn(0, std::sqrt(kSlip + kFixes)),
        aside(0, std::sqrt(6 * kAside + kSeen));
    for (int i = 0; i < 12; ++i) {
      const SlipResidual turned{turn(random), kSlip, kFixes, kApart_m};
      turns_only.AddTurn(turned);
      both.AddTurn(turned);
      both.AddAcross({aside(random), kAside, kSeen, kApart_m});
    }
    straight += turns_only.factor() / 50;
    sideways += both.factor() / 50;
  }
  EXPECT_GT(sideways, 1.4 * straight);
}

TEST(SlipScale, AConstantTurnIsNoSlip) {
  double sum = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) sum += After(12, 1, 0.006, seed) / 50;
  EXPECT_LT(sum, 1.6);
}

TEST(SlipScale, WhatIsNoNumberTellsNothing) {
  SlipScale scale;
  scale.AddTurn({std::nan(""), kSlip, kFixes, kApart_m});
  scale.AddAcross({0.1, 0, 0, kApart_m});
  EXPECT_NEAR(scale.factor(), 1, 0.06);
}

}  // namespace
}  // namespace priamos::robot
