#include "world/core/head/gain_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::world {
namespace {

TEST(GainDriftTest, WithoutQuirksTheGainIsExactlyTheNominalOne) {
  GainDrift dut(CameraQuirks{}, Rng(1));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(dut.At(kLeftCamera, FromUtime(i * 1'000'000)), 1.0);
}

TEST(GainDriftTest, WandersSlowlyAroundTheGainOfItsCamera) {
  CameraQuirks quirks;
  quirks.gain_drift = 0.05;
  quirks.gain_drift_s = 10;
  quirks.cameras[kRightCamera].gain = 1.3;
  GainDrift dut(quirks, Rng(1));
  double sum = 0, sum2 = 0, steps2 = 0, before = 1.3;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const double gain = dut.At(kRightCamera, FromUtime(i * 1'000'000LL));
    sum += gain;
    sum2 += gain * gain;
    if (i > 0) steps2 += (gain - before) * (gain - before);
    before = gain;
  }
  const double mean = sum / kSamples, sigma = std::sqrt(sum2 / kSamples - mean * mean);
  EXPECT_NEAR(mean, 1.3, 0.02);
  EXPECT_NEAR(sigma / 1.3, 0.05, 0.005);
  // A tenth of the time constant: sqrt(2 (1 - exp(-0.1))) of the sigma.
  EXPECT_NEAR(std::sqrt(steps2 / kSamples) / sigma, std::sqrt(2 * (1 - std::exp(-0.1))), 0.03);
}

TEST(DrawQuirksTest, StayWithinTheirSpreadsAndDifferBetweenCameras) {
  const CameraQuirksPlan plan{0.2, 0.01, 60, 0.5, 0.001, 0.05};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const CameraQuirks dut = DrawQuirks(plan, seed);
    EXPECT_NE(dut.cameras[0].gain, dut.cameras[1].gain);
    for (const CameraQuirk& camera : dut.cameras) {
      EXPECT_LE(std::abs(camera.gain - 1), 0.2);
      EXPECT_LE(std::abs(camera.defocus_dioptre), 0.5);
      EXPECT_LE(std::abs(camera.p1), 0.001);
      EXPECT_LE(std::abs(camera.k3), 0.05);
    }
  }
}

}  // namespace
}  // namespace priamos::world
