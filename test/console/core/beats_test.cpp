#include "console/core/beats.hpp"

#include <gtest/gtest.h>

namespace priamos::console {
namespace {

using std::chrono::milliseconds;

TEST(Beats, TheAgeCountsFromTheMomentTheBeatWasSent) {
  Beats dut;
  const Time start{milliseconds(5000)};
  const auto first = dut.Next(start);
  const auto second = dut.Next(start + milliseconds(50));
  EXPECT_EQ(dut.AgeOf(first, start + milliseconds(80)), milliseconds(80));
  EXPECT_EQ(dut.AgeOf(second, start + milliseconds(80)), milliseconds(30));
}

TEST(Beats, WhatWasNeverSentOrIsForgottenIsTooOldForAnything) {
  Beats dut;
  Time now{milliseconds(5000)};
  EXPECT_EQ(dut.AgeOf(1, now), Duration::max());
  const auto first = dut.Next(now);
  EXPECT_EQ(dut.AgeOf(first + 1, now), Duration::max());
  EXPECT_EQ(dut.AgeOf(0, now), Duration::max());
  EXPECT_EQ(dut.AgeOf(-63, now), Duration::max());
  for (int i = 0; i < 63; ++i) dut.Next(now += milliseconds(50));
  EXPECT_EQ(dut.AgeOf(first, now), milliseconds(63 * 50));
  dut.Next(now);
  EXPECT_EQ(dut.AgeOf(first, now), Duration::max());
}

}  // namespace
}  // namespace priamos::console
