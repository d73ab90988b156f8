#include "head/core/drift/drift_monitor.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/config.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;
using support::Between;

constexpr double kSigma_rad = 1e-4;

/// A look that measured turns of so many standard deviations about x, y and z.
StereoDrift Look(double x, double y, double z) {
  return {kSigma_rad * Vector3d(x, y, z), kSigma_rad * kSigma_rad * Eigen::Matrix3d::Identity()};
}

DriftMonitor After(const std::vector<StereoDrift>& looks, const DriftConfig& config = {}) {
  DriftMonitor dut(config);
  for (const StereoDrift& look : looks) dut.Add(look);
  return dut;
}

TEST(DriftMonitorTest, FewLooksAreNotJudgedAndGoodOnesEndTheAlarm) {
  DriftConfig config;
  DriftMonitor dut(config);
  StereoDrift bad{{0, 0.01, 0}, Vector3d(1e-8, 1e-8, 1e-8).asDiagonal()},
      good{Vector3d::Zero(), bad.covariance};
  for (int i = 0; i < config.looks - 1; ++i) dut.Add(bad);
  EXPECT_FALSE(dut.alarm());
  dut.Add(bad);
  ASSERT_TRUE(dut.alarm());
  EXPECT_EQ(dut.alarm()->axis, 1);
  EXPECT_EQ(
      dut.alarm()->ToText(),
      "cameras out of calibration: right turned 0.573 deg sideways (vergence), 100 sigma; calibrate again");
  EXPECT_LE(dut.alarm()->ToText().size(), 100u) << "what HEALTH has room for";
  dut.Add(good);
  EXPECT_TRUE(dut.alarm()) << "one look is not enough, neither way";
  dut.Add(good);
  EXPECT_FALSE(dut.alarm());
}

TEST(DriftMonitorTest, AnEvenNumberOfLooksIsRefused) {
  EXPECT_THROW(ParseConfig<DriftConfig>("head.toml", "looks = 4\n"), ConfigError);
}

TEST(DriftMonitorTest, QuantilesOfTheNormalDistribution) {
  EXPECT_NEAR(NormalQuantile(0.5), 0, 1e-9);
  EXPECT_NEAR(NormalQuantile(0.025), 1.959964, 1e-5);
  EXPECT_NEAR(NormalQuantile(1e-6), 4.753424, 1e-5);
}

TEST(DriftMonitorTest, TheMedianOfTheLooksIsJudged) {
  const auto outlier = After({Look(0, 50, 0), Look(0, 1, 0), Look(0, 1, 0)});
  EXPECT_FALSE(outlier.alarm()) << "one look that went wrong";
  const auto most = After({Look(0, 9, 0), Look(0, 1, 0), Look(0, 7, 0)});
  ASSERT_TRUE(most.alarm());
  EXPECT_NEAR(most.alarm()->deviations, 7, 1e-9);
  EXPECT_NEAR(most.alarm()->drift.turn_rad.y(), 7 * kSigma_rad, 1e-12) << "as the median look has it";
}

TEST(DriftMonitorTest, LooksThatContradictEachOtherRaiseNoAlarm) {
  EXPECT_FALSE(After({Look(9, 0, 0), Look(-9, 0, 0), Look(0.5, 0, 0)}).alarm());
  EXPECT_TRUE(After({Look(-9, 0, 0), Look(-9, 0, 0), Look(9, 0, 0)}).alarm()) << "to either side";
}

TEST(DriftMonitorTest, TheWorstAxisIsNamed) {
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d turn(6, 6, 6);
    turn[axis] = -8;
    const StereoDrift look = Look(turn.x(), turn.y(), turn.z());
    const auto dut = After({look, look, look});
    ASSERT_TRUE(dut.alarm());
    EXPECT_EQ(dut.alarm()->axis, axis);
    EXPECT_NEAR(dut.alarm()->deviations, 8, 1e-9);
  }
}

TEST(DriftMonitorTest, EveryAxisHasItsOwnUncertainty) {
  StereoDrift look = Look(1, 30, 1);
  look.covariance(1, 1) *= 100;  // 10 sigma: 30 become 3
  look.covariance(2, 2) /= 100;  // 0.1 sigma: 1 becomes 10
  const auto dut = After({look, look, look});
  ASSERT_TRUE(dut.alarm());
  EXPECT_EQ(dut.alarm()->axis, 2);
  EXPECT_NEAR(dut.alarm()->deviations, 10, 1e-9);
}

TEST(DriftMonitorTest, TheLimitKeepsThePromisedRateOfFalseAlarms) {
  // Twelve chances (Markov's two, three axes, two sides) of a normal variable share the probability.
  for (const double rate : {0.1, 0.01, 1e-4, 1e-9}) {
    const double limit = DriftMonitor({.false_alarm = rate}).limit();
    EXPECT_NEAR(12 * 0.5 * std::erfc(limit / std::sqrt(2.0)), rate, 1e-6 * rate);
  }
}

TEST(DriftMonitorTest, BeyondTheLimitIsAnAlarm) {
  const double limit = DriftMonitor({}).limit();
  const StereoDrift below = Look(limit - 0.001, 0, 0), above = Look(limit + 0.001, 0, 0);
  EXPECT_FALSE(After({below, below, below}).alarm());
  EXPECT_TRUE(After({above, above, above}).alarm());
}

TEST(DriftMonitorTest, OnlyTheLastLooksCount) {
  std::vector<StereoDrift> looks(10, Look(0, 20, 0));
  looks.insert(looks.end(), 2, Look(0, 0, 0));
  EXPECT_FALSE(After(looks).alarm());
  EXPECT_TRUE(After(looks, {.looks = 5}).alarm());
  EXPECT_FALSE(After({Look(0, 0, 0), Look(0, 0, 0)}, {.looks = 1}).alarm());
  EXPECT_TRUE(After({Look(0, 20, 0)}, {.looks = 1}).alarm());
}

TEST(DriftMonitorTest, TheAlarmTellsHowTheCameraTurned) {
  const DriftAlarm up{Look(-10, 0, 0), 0, 10}, roll{Look(0, 0, 10), 2, 10};
  EXPECT_EQ(up.ToText(),
            "cameras out of calibration: right turned -0.057 deg up or down, 10 sigma; calibrate again");
  EXPECT_EQ(
      roll.ToText(),
      "cameras out of calibration: right turned 0.057 deg about its axis (roll), 10 sigma; calibrate again");
}

TEST(DriftMonitorTest, SettingsHaveBounds) {
  EXPECT_EQ(ParseConfig<DriftConfig>("head.toml", "looks = 5\n").looks, 5);
  for (const char* text :
       {"looks = 0\n", "looks = 101\n", "false_alarm = 0.2\n", "calibration_sigma_px = 0\n"})
    EXPECT_THROW(ParseConfig<DriftConfig>("head.toml", text), ConfigError) << text;
}

RC_GTEST_PROP(NormalQuantileTest, IsExceededWithItsProbability, ()) {
  const double probability = std::pow(10, Between(-12, std::log10(0.5)));
  const double x = NormalQuantile(probability);
  RC_ASSERT(x >= 0);
  RC_ASSERT(std::abs(0.5 * std::erfc(x / std::sqrt(2.0)) - probability) < 1e-6 * probability);
}

}  // namespace
}  // namespace priamos::head
