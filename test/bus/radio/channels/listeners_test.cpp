#include "bus/radio/channels/listeners.hpp"

#include <gtest/gtest.h>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
Time After(double s) {
  return kStart + FromSeconds(s);
}

TEST(Listeners, AChangeIsToldAtOnceAndRepeatedWhileSomebodyListens) {
  Listeners dut;
  EXPECT_FALSE(dut.Due(kStart));
  dut.Listen(3, true);
  EXPECT_TRUE(dut.changed() && dut.Due(kStart));
  EXPECT_EQ(dut.Take(kStart).channels, 0b1000U);
  EXPECT_FALSE(dut.changed() || dut.Due(After(1.999)));
  EXPECT_TRUE(dut.Due(After(2)));
  EXPECT_FALSE(dut.changed());  // not worth a frame of its own
}

TEST(Listeners, NobodyIsToldOnce) {
  Listeners dut;
  dut.Listen(3, true);
  dut.Take(kStart);
  dut.Listen(3, false);
  EXPECT_EQ(dut.Take(After(1)).channels, 0U);
  EXPECT_FALSE(dut.Due(After(100)));
}

TEST(Listeners, TheSameAgainIsNoChange) {
  Listeners dut;
  dut.Listen(3, false);
  EXPECT_FALSE(dut.changed());
}

TEST(Listeners, CutOffItIsDueAgain) {
  Listeners dut;
  dut.Listen(0, true);
  dut.Take(kStart);
  dut.Return();
  EXPECT_TRUE(dut.Due(kStart));
}

TEST(Listeners, TheOtherEndIsBelievedForSixSeconds) {
  Listeners dut;
  EXPECT_FALSE(dut.TakeExpiry(kStart));
  dut.OnListen({1}, kStart);
  EXPECT_FALSE(dut.TakeExpiry(After(5.999)));
  EXPECT_TRUE(dut.TakeExpiry(After(6)));
  EXPECT_FALSE(dut.TakeExpiry(After(7)));  // once
}

TEST(Listeners, ThatNobodyListensThereNeedsNoExpiry) {
  Listeners dut;
  dut.OnListen({0}, kStart);
  EXPECT_FALSE(dut.TakeExpiry(After(100)));
}

}  // namespace
}  // namespace priamos::bus::radio
