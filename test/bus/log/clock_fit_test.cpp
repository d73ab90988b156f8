#include "bus/log/clock_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace priamos::bus {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

/// A clock that is 12.5 s ahead and drifts.
std::vector<StampPair> Pairs(int n, double drift, double error_us, double bias_us, Rng& rng) {
  std::vector<StampPair> pairs;
  for (int i = 0; i < n; ++i) {
    const std::int64_t b = 1'000 * kSecond + i * kSecond / 4;
    const double a = static_cast<double>(b) + 12.5e6 + drift * static_cast<double>(b - 1'000 * kSecond);
    const bool from_a = i % 3 != 0;
    const double error = error_us * (2 * rng.Uniform(0, 1) - 1) + (from_a ? bias_us : -bias_us);
    pairs.push_back({std::llround(a + error), b, from_a});
  }
  return pairs;
}

TEST(FitClocks, NothingGivesNothing) {
  EXPECT_FALSE(FitClocks({}));
}

TEST(FitClocks, OnePairGivesTheOffset) {
  const auto dut = FitClocks({{5 * kSecond, 2 * kSecond, true}});
  EXPECT_EQ(dut->ToA(2 * kSecond), 5 * kSecond);
  EXPECT_EQ(dut->drift, 0);
}

TEST(FitClocks, FindsOffsetAndDriftThroughQuantisedStamps) {
  Rng rng(1);
  const auto dut = FitClocks(Pairs(400, 80e-6, 5'000, 0, rng));
  EXPECT_NEAR(dut->drift, 80e-6, 20e-6);
  const std::int64_t b = 1'050 * kSecond;
  EXPECT_NEAR(static_cast<double>(dut->ToA(b) - b), 12.5e6 + 80e-6 * 50e6, 1'000);
  EXPECT_EQ(dut->outliers, 0u);
}

TEST(FitClocks, AThirdOfWrongPairsDoesNoHarm) {
  Rng rng(2);
  auto pairs = Pairs(300, 0, 5'000, 0, rng);
  for (std::size_t i = 0; i < pairs.size(); i += 3) pairs[i].a_us += 3 * kSecond + rng.Below(1'000'000);
  const auto dut = FitClocks(pairs);
  EXPECT_NEAR(dut->offset_us, 12.5e6, 3'000);
  EXPECT_EQ(dut->outliers, 100u);
}

TEST(FitClocks, WhatBothDirectionsHaveInCommonCancels) {
  Rng rng(3);
  const auto dut = FitClocks(Pairs(300, 0, 1'000, 20'000, rng));
  EXPECT_TRUE(dut->both_ways);
  EXPECT_NEAR(dut->offset_us, 12.5e6, 1'000);
  EXPECT_NEAR(dut->asymmetry_us, 20'000, 1'000);
}

TEST(FitClocks, AShortRunHasNoDrift) {
  Rng rng(4);
  EXPECT_EQ(FitClocks(Pairs(40, 0, 5'000, 0, rng))->drift, 0);
}

}  // namespace
}  // namespace priamos::bus
