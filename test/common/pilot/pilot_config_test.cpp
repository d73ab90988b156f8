#include "common/pilot/pilot_config.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "common/config.hpp"

namespace priamos {
namespace {

double Between(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 10001)) / 10000.0;
}

RC_GTEST_PROP(AxisShape, IsOddMonotonicAndWithinItsLimits, ()) {
  AxisShape dut;
  dut.dead_band = Between(0, 0.5);
  dut.expo = Between(0, 1);
  const double a = Between(-1, 1), b = Between(-1, 1);
  RC_ASSERT(dut(-a) == -dut(a));
  RC_ASSERT(std::abs(dut(a)) <= 1);
  if (a <= b) RC_ASSERT(dut(a) <= dut(b));
  if (std::abs(a) <= dut.dead_band) RC_ASSERT(dut(a) == 0);
}

TEST(AxisShape, FullDeflectionIsAllAndExpoIsFineNearTheMiddle) {
  AxisShape dut;
  EXPECT_DOUBLE_EQ(dut(1), 1);
  EXPECT_DOUBLE_EQ(dut(1.7), 1);
  EXPECT_LT(dut(0.3), (0.3 - dut.dead_band) / (1 - dut.dead_band));
  EXPECT_EQ(dut(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(PilotConfig, ATimeToLiveThatOneLostCommandEndsIsRefused) {
  EXPECT_THROW(ParseConfig<PilotConfig>("x", "time_to_live_s = 0.05\n"), ConfigError);
  EXPECT_NO_THROW(ParseConfig<PilotConfig>("x", "time_to_live_s = 0.1\n"));
}

TEST(PilotConfig, ADeadManIsNeeded) {
  EXPECT_THROW(ParseConfig<PilotConfig>("x", "[buttons]\ndead_man = -1\n"), ConfigError);
}

}  // namespace
}  // namespace priamos
