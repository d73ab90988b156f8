#include "bus/clocks/host_clock.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

class HostClockTest : public testing::Test {
 protected:
  HostClockTest() { setenv("PRIAMOS_RUNTIME", (folder_ / "runtime").c_str(), 1); }
  ~HostClockTest() override { unsetenv("PRIAMOS_RUNTIME"); }
  TemporaryFolder folder_;
};

TEST_F(HostClockTest, TwoOfOneHostSayTheSame) {
  const HostClock first, second;
  EXPECT_EQ(first.anchor().unix_minus_boot, second.anchor().unix_minus_boot);
  EXPECT_LT(second.Now() - first.Now(), seconds(10));
  const Time before = first.Now();
  EXPECT_LE(before, second.Now());
}

/// Two that were copied while they ran have one boot and one anchor.
TEST_F(HostClockTest, OfMachinesAtDifferentAddressesAreDifferent) {
  const HostClock dut, same;
  EXPECT_EQ(dut.IdAt("10.77.0.1"), same.IdAt("10.77.0.1"));
  EXPECT_NE(dut.IdAt("10.77.0.1"), same.IdAt("10.77.0.2"));
}

TEST_F(HostClockTest, TheFirstOneIsTheWallClock) {
  const HostClock dut;
  EXPECT_LT(std::chrono::abs(dut.WallAhead()), seconds(1));
}

TEST_F(HostClockTest, TheWallClockMayHaveBeenSetSince) {
  const HostClock first;
  const HostClock dut(ClockAnchor{first.anchor().unix_minus_boot - hours(1), {}, ""});
  EXPECT_LT(std::chrono::abs(dut.WallAhead() - hours(1)), seconds(1));
  EXPECT_LT(std::chrono::abs(first.Now() - dut.Now() - hours(1)), seconds(1));
}

TEST_F(HostClockTest, NeverGoesBack) {
  const HostClock dut;
  Time last = dut.Now();
  for (int i = 0; i < 10000; ++i) {
    const Time now = dut.Now();
    ASSERT_GE(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace priamos::bus
