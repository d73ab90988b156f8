#include "bus/radio/line/link_quality.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);

TEST(LossMeter, FindsTheLossAndTheBitErrorRate) {
  LossMeter dut;
  Rng rng(1);
  std::uint64_t missed = 0;
  double loss = 0;
  int n = 0;
  for (int i = 0; i < 20000; ++i) {
    if (rng.Chance(0.2)) {
      ++missed;
      continue;
    }
    dut.OnFrame(missed, 50);
    missed = 0;
    loss += dut.loss();
    ++n;
  }
  EXPECT_NEAR(loss / n, 0.2, 0.03);
  LossMeter clean;
  EXPECT_EQ(clean.BitErrorRate(), 0);
}

TEST(LossMeter, BitErrorRateExplainsTheLoss) {
  LossMeter dut;
  for (int i = 0; i < 400; ++i) dut.OnFrame(1, 50);  // every second frame of 50 bytes
  EXPECT_NEAR(dut.BitErrorRate(), 0.00139, 0.0001);
}

TEST(ForgeryGuard, NoiseIsNoForgery) {
  ForgeryGuard dut(137, kStart);
  Rng rng(1);
  Time now = kStart;
  for (int i = 0; i < 10000; ++i) {
    now += Duration(100'000);
    EXPECT_TRUE(dut.MayTry(Claim::kOther, now));
    if (rng.Chance(0.5)) {
      dut.OnBadCode(now);
      dut.OnMissed(1);
    }
    EXPECT_FALSE(dut.alarm(now));
  }
}

TEST(ForgeryGuard, TwoMissedFramesExplainThreeDamagedOnes) {
  ForgeryGuard dut(137, kStart);
  for (int i = 0; i < 40; ++i) {
    for (int piece = 0; piece < 3; ++piece) dut.OnBadCode(kStart);
    dut.OnMissed(2);
  }
  EXPECT_FALSE(dut.alarm(kStart));
}

TEST(ForgeryGuard, FramesBeyondTheOtherEndsRaiseTheAlarm) {
  ForgeryGuard dut(137, kStart);
  Time now = kStart;
  for (int i = 0; i < 30; ++i) {
    now += Duration(100'000);
    dut.OnBadCode(now);
  }
  EXPECT_TRUE(dut.alarm(now));
  EXPECT_FALSE(dut.alarm(now + Duration(60'000'000)));
}

TEST(ForgeryGuard, OneReplayIsEnough) {
  ForgeryGuard dut(137, kStart);
  dut.OnReplay(kStart);
  EXPECT_TRUE(dut.alarm(kStart));
}

TEST(ForgeryGuard, TriesAreBounded) {
  ForgeryGuard dut(100, kStart);
  int tries = 0;
  for (int i = 0; i < 100000; ++i) tries += dut.MayTry(Claim::kOther, kStart + Duration(i * 100)) ? 1 : 0;
  EXPECT_NEAR(tries, 1000 + 256, 2);
  EXPECT_TRUE(dut.alarm(kStart + Duration(10'000'000)));
}

TEST(AnswerLimit, SomeAtOnceFewOnAverage) {
  AnswerLimit dut(kStart);
  int answers = 0;
  for (int i = 0; i < 10000; ++i) {
    const Time now = kStart + Duration(i * 1000);
    if (!dut.Allows(now)) continue;
    dut.Use(now);
    ++answers;
  }
  EXPECT_NEAR(answers, 24, 1);
}

TEST(LatencyMeter, HalfOfTheSmallestRoundTrip) {
  LatencyMeter dut;
  EXPECT_EQ(dut.one_way(), Duration(0));
  for (const int us : {20'000, 12'000, 30'000}) dut.Sample(Duration(us));
  EXPECT_EQ(dut.one_way(), Duration(6'000));
  dut.Sample(Duration(-10));
  EXPECT_EQ(dut.one_way(), Duration(0));
}

}  // namespace
}  // namespace priamos::bus::radio
