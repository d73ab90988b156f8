#include "bus/radio/transmitter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bus/radio/frame/frame.hpp"
#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
const LinkOptions kThousandBytes{.bytes_per_s = 1000, .ahead_bytes = 2};

std::vector<std::byte> Frame(std::size_t bytes) {
  std::vector<std::byte> frame(bytes, std::byte{'x'});
  frame.back() = kDelimiter;
  return frame;
}

/// Everything that may leave at `now`.
std::vector<std::byte> Drain(Transmitter& dut, Time now) {
  std::vector<std::byte> out;
  while (dut.busy() && dut.Allows(now)) dut.Emit(now, out);
  return out;
}

TEST(Transmitter, KeepsThePaceOfTheLine) {
  Transmitter dut(kThousandBytes, kStart);
  dut.Begin(Frame(100), kStart);
  std::size_t sent = 0;
  for (int ms = 0; ms < 50; ++ms) {
    sent += Drain(dut, kStart + Duration(1000 * ms)).size();
    EXPECT_EQ(sent, static_cast<std::size_t>(ms) + 3);  // one being sent, two ahead of it
  }
  EXPECT_EQ(dut.bytes_sent(), sent);
}

TEST(Transmitter, AFrameOccupiesTheLineWithTheHeadOfItsDatagram) {
  LinkOptions datagrams = kThousandBytes;
  datagrams.datagrams = true;
  EXPECT_EQ(Transmitter(kThousandBytes, kStart).Occupies(100), Duration(100'000));
  EXPECT_EQ(Transmitter(datagrams, kStart).Occupies(100),
            Duration(1000 * static_cast<std::int64_t>(100 + kDatagramHead)));
}

TEST(Transmitter, ADelimiterLeadsAfterSilence) {
  Transmitter dut(kThousandBytes, kStart);
  dut.Begin(Frame(2), kStart);
  EXPECT_EQ(Drain(dut, kStart), (std::vector{kDelimiter, std::byte{'x'}, kDelimiter}));
  dut.Begin(Frame(2), kStart + Duration(10'000));
  EXPECT_EQ(Drain(dut, kStart + Duration(10'000)), Frame(2));
  dut.Begin(Frame(2), kStart + Duration(60'000));
  EXPECT_EQ(Drain(dut, kStart + Duration(60'000)).front(), kDelimiter);
}

TEST(Transmitter, WhatWasBegunIsEndedByADelimiter) {
  Transmitter dut(kThousandBytes, kStart);
  dut.Begin(Frame(100), kStart);
  Drain(dut, kStart + Duration(10'000));
  EXPECT_TRUE(dut.WorthCutting());
  std::vector<std::byte> out;
  dut.Cut(kStart + Duration(10'000), out);
  EXPECT_EQ(out, std::vector{kDelimiter});
  EXPECT_FALSE(dut.busy());
}

TEST(Transmitter, WhatWasNotBegunLeavesNoTrace) {
  Transmitter dut(kThousandBytes, kStart);
  dut.Begin(Frame(100), kStart);
  std::vector<std::byte> out;
  dut.Cut(kStart, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(dut.bytes_sent(), 0U);
}

TEST(Transmitter, TheLastTwoBytesAreFasterSentThanCut) {
  Transmitter dut(kThousandBytes, kStart);
  dut.Begin(Frame(4), kStart);  // and a leading delimiter
  std::vector<std::byte> out;
  for (const bool worth : {true, true, false, false, false}) {
    dut.Emit(kStart, out);
    EXPECT_EQ(dut.WorthCutting(), worth) << out.size();
  }
  EXPECT_FALSE(dut.busy());
}

TEST(Transmitter, ADatagramGoesWholeAndPaysForItsHead) {
  Transmitter dut({.bytes_per_s = 1000, .ahead_bytes = 2, .datagrams = true}, kStart);
  dut.Begin(Frame(50), kStart);
  std::vector<std::byte> out;
  dut.Emit(kStart, out);
  EXPECT_EQ(out, Frame(50));
  EXPECT_FALSE(dut.busy());
  EXPECT_FALSE(dut.Allows(kStart + Duration(75'000)));
  EXPECT_TRUE(dut.Allows(kStart + Duration(76'000)));  // 50 + 28 bytes, two ahead
  EXPECT_EQ(dut.OnTheWay(50), Duration::zero());
  EXPECT_EQ(dut.LeavesAt(50, kStart), kStart);
}

TEST(Transmitter, APacketOccupiesTheAirUntilItEnds) {
  Transmitter dut({.bytes_per_s = 1000,
                   .ahead_bytes = 2,
                   .datagrams = true,
                   .packet_overhead = Duration(40'000),
                   .packet_bytes = 100},
                  kStart);
  dut.Begin(Frame(50), kStart);
  std::vector<std::byte> out;
  dut.Emit(kStart, out);
  EXPECT_EQ(out, Frame(50));
  EXPECT_FALSE(dut.Allows(kStart + Duration(87'000)));
  EXPECT_TRUE(dut.Allows(kStart + Duration(88'000)));
  EXPECT_EQ(dut.OnTheWay(50), Duration(90'000));
  EXPECT_EQ(dut.LeavesAt(50, kStart), kStart + Duration(180'000));
}

RC_GTEST_PROP(Transmitter, NeverMoreThanTheLineCarries, (std::uint64_t seed)) {
  Rng rng(seed);
  const LinkOptions options{.bytes_per_s = rng.Uniform(100, 10'000),
                            .ahead_bytes = static_cast<int>(rng.Below(8))};
  Transmitter dut(options, kStart);
  Time now = kStart;
  double sent = 0;
  int cuts = 0;
  for (int i = 0; i < 300; ++i) {
    now += Duration(rng.Below(20'000));
    if (!dut.busy()) dut.Begin(Frame(1 + rng.Below(200)), now);
    std::vector<std::byte> out = Drain(dut, now);
    if (dut.busy() && rng.Chance(0.1)) {
      dut.Cut(now, out);
      ++cuts;
    }
    sent += static_cast<double>(out.size());
    // The byte being sent, those ahead of it, and the delimiters of cuts.
    RC_ASSERT(sent <= Seconds(now - kStart) * options.bytes_per_s + options.ahead_bytes + 1 + cuts);
  }
}

}  // namespace
}  // namespace priamos::bus::radio
