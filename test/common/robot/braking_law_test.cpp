#include "common/robot/braking_law.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/random.hpp"

namespace priamos {
namespace {

TEST(BrakingLaw, LatencyAndBrakingAddUp) {
  const BrakingLaw dut{.deceleration_m_s2 = 0.5, .latency_s = 0.2};
  EXPECT_NEAR(dut.Distance(1), 0.2 + 1.0, 1e-12);
  EXPECT_NEAR(dut.SpeedWithin(1.2), 1, 1e-12);
}

TEST(BrakingLaw, WhereNothingIsFreeNothingMoves) {
  const BrakingLaw dut;
  EXPECT_EQ(dut.SpeedWithin(0), 0);
  EXPECT_EQ(dut.SpeedWithin(-0.3), 0);
}

TEST(BrakingLaw, AfterTheLatencyItSlowsDownToAnySpeed) {
  const BrakingLaw dut{.deceleration_m_s2 = 0.5, .latency_s = 0.2};
  EXPECT_NEAR(dut.SpeedBefore(0, 1), 1, 1e-12);
  EXPECT_NEAR(dut.SpeedBefore(0.6, 0.64), 1, 1e-12);
  EXPECT_EQ(dut.SpeedBefore(0.3, -0.1), 0.3);
}

/// In steps of 0.1 ms, as a base would do it.
double Driven(const BrakingLaw& law, double speed_m_s) {
  constexpr double kStep_s = 1e-4;
  double distance_m = 0;
  for (double t = 0; speed_m_s > 0; t += kStep_s) {
    distance_m += speed_m_s * kStep_s;
    if (t >= law.latency_s) speed_m_s -= law.deceleration_m_s2 * kStep_s;
  }
  return distance_m;
}

RC_GTEST_PROP(BrakingLaw, IsTheDistanceDrivenAndItsInverse, (std::uint64_t seed)) {
  Rng rng(seed);
  const BrakingLaw dut{.deceleration_m_s2 = rng.Uniform(0.1, 5), .latency_s = rng.Uniform(0, 1)};
  const double speed_m_s = rng.Uniform(0.01, 2);
  RC_ASSERT(std::abs(dut.Distance(speed_m_s) - Driven(dut, speed_m_s)) < 1e-3);
  RC_ASSERT(std::abs(dut.SpeedWithin(dut.Distance(speed_m_s)) - speed_m_s) < 1e-9);
}

}  // namespace
}  // namespace priamos
