#include "bus/radio/line/duty_cycle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000);

TEST(DutyCycle, IsNoLimitByDefault) {
  DutyCycle dut;
  EXPECT_FALSE(dut.limited());
  dut.Use(kStart, FromSeconds(1000));
  EXPECT_TRUE(dut.Allows(kStart, false));
}

TEST(DutyCycle, AnOrdinaryFrameWaitsUntilTheOneBeforeIsPaid) {
  DutyCycle dut(0.12, FromSeconds(3600));  // 0.1 in the long run
  EXPECT_TRUE(dut.Allows(kStart, false));
  dut.Use(kStart, FromSeconds(0.2));
  EXPECT_FALSE(dut.Allows(kStart + FromSeconds(1.99), false));
  EXPECT_TRUE(dut.Allows(kStart + FromSeconds(2.01), false));
  EXPECT_TRUE(dut.Allows(kStart, true)) << "what is urgent goes on credit";
}

TEST(DutyCycle, CreditEnds) {
  DutyCycle dut(0.12, FromSeconds(100));  // credit of 10 s, in which 1 s of air is paid
  EXPECT_NEAR(Seconds(dut.credit()), 1, 1e-5);
  EXPECT_NEAR(Seconds(dut.longest()), 1, 1e-5);
  dut.Use(kStart, FromSeconds(0.9));
  EXPECT_TRUE(dut.Allows(kStart, true));
  dut.Use(kStart, FromSeconds(0.9));
  EXPECT_FALSE(dut.Allows(kStart, true));
}

/// Whatever is sent when: no window of the length holds more than the share.
RC_GTEST_PROP(DutyCycle, HoldsInEveryWindow, (const std::vector<std::uint8_t>& steps)) {
  const double share = 0.1, window_s = 20;
  DutyCycle dut(share, FromSeconds(window_s));
  std::vector<std::pair<double, double>> frames;
  double now_s = 0;
  for (const std::uint8_t step : steps) {
    now_s += 0.02 * (step % 16);
    const double air_s = 0.01 * (1 + step / 16);  // longest() is 0.166
    if (!dut.Allows(kStart + FromSeconds(now_s), step % 3 != 0)) continue;
    dut.Use(kStart + FromSeconds(now_s), FromSeconds(air_s));
    frames.emplace_back(now_s, air_s);
    now_s += air_s;
  }
  for (std::size_t first = 0; first < frames.size(); ++first) {
    double on_air_s = 0;
    for (std::size_t i = first; i < frames.size(); ++i) {
      if (frames[i].first + frames[i].second > frames[first].first + window_s) break;
      on_air_s += frames[i].second;
    }
    RC_ASSERT(on_air_s <= share * window_s);
  }
}

}  // namespace
}  // namespace priamos::bus::radio
