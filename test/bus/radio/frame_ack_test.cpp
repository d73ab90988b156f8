#include "bus/radio/frame_ack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "common/random.hpp"

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Time kStart = FromUtime(1'000'000'000);
Time After(double s) {
  return kStart + FromSeconds(s);
}

TEST(FrameAckSender, NothingHeardNothingToSay) {
  const FrameAckSender dut;
  EXPECT_FALSE(dut.Due(kStart));
}

TEST(FrameAckSender, AtOnceThenFourTimesASecond) {
  FrameAckSender dut;
  dut.OnFrame(1);
  EXPECT_TRUE(dut.Due(kStart));
  const FrameAckEntry ack = dut.Take(0x5123, After(-0.04), 0.25, kStart);
  EXPECT_EQ(ack.counter, 0x123);
  EXPECT_EQ(ack.hold, Duration(40'000));
  EXPECT_EQ(ack.loss, 0.25);
  dut.OnFrame(1);
  EXPECT_FALSE(dut.Due(After(0.249)));
  EXPECT_TRUE(dut.Due(After(0.25)));
}

TEST(FrameAckSender, ManyFramesPress) {
  FrameAckSender dut;
  dut.OnFrame(1);
  dut.Take(1, kStart, 0, kStart);
  for (int i = 0; i < 23; ++i) dut.OnFrame(1);
  EXPECT_FALSE(dut.Pressing() || dut.Due(kStart));
  dut.OnFrame(1);
  EXPECT_TRUE(dut.Pressing() && dut.Due(kStart));
}

TEST(FrameAckSender, NamesWhatCameInItsTurn) {
  FrameAckSender dut;
  dut.OnFrame(1);                                             // 1
  dut.OnFrame(2);                                             // 3
  dut.OnFrame(0);                                             // 2, overtaken
  dut.OnFrame(1);                                             // 4
  EXPECT_EQ(dut.Take(4, kStart, 0, kStart).earlier, 0b0101);  // 3 and 1
  dut.OnFrame(64);
  EXPECT_EQ(dut.Take(68, kStart, 0, kStart).earlier, 0);
}

TEST(FrameAckSender, CutOffItIsDueAgain) {
  FrameAckSender dut;
  dut.OnFrame(1);
  dut.Take(1, kStart, 0, kStart);
  EXPECT_FALSE(dut.Due(kStart));
  dut.Return();
  EXPECT_TRUE(dut.Due(kStart));
}

TEST(SentFrames, AShortCounterNeedsAReportNearby) {
  SentFrames dut;
  EXPECT_EQ(dut.FormOf(1), CounterForm::kWhole);
  dut.OnSent(10, kStart);
  dut.OnAck({.counter = 10}, After(0.1));
  EXPECT_EQ(dut.FormOf(74), CounterForm::kLowBits);
  EXPECT_EQ(dut.FormOf(75), CounterForm::kWhole);
  dut.OnFloor();
  EXPECT_EQ(dut.FormOf(11), CounterForm::kWhole);
  dut.OnEpochChanged();
  EXPECT_EQ(dut.FormOf(64), CounterForm::kLowBits);  // both begin with 1
}

TEST(SentFrames, KnowsWhenAFrameWasHandedOverButNotOneThatNeverWas) {
  SentFrames dut;
  dut.OnHandedOver(10, After(1));
  dut.OnHandedOver(12, After(2));  // 11 was cut off
  EXPECT_EQ(dut.HandedOver(10), After(1));
  EXPECT_EQ(dut.HandedOver(12), After(2));
  for (const std::uint64_t counter : {9U, 11U, 13U}) EXPECT_FALSE(dut.HandedOver(counter)) << counter;
  dut.OnEpochChanged();
  EXPECT_FALSE(dut.HandedOver(10));
}

TEST(SentFrames, RemembersAllThatOneByteCanName) {
  SentFrames dut;
  for (std::uint64_t i = 1; i <= 10'000; ++i) dut.OnHandedOver(i, After(static_cast<double>(i)));
  EXPECT_EQ(dut.HandedOver(10'000 - 255), After(10'000 - 255));
  EXPECT_FALSE(dut.HandedOver(1));
}

TEST(SentFrames, TheLastRoundTripMayGrowAndIsNeverBelowZero) {
  SentFrames dut;
  dut.OnSent(10, kStart);
  dut.OnAck({.counter = 10, .hold = Duration(20'000)}, After(0.1));
  EXPECT_EQ(dut.last_round_trip(), Duration(80'000));
  dut.OnSent(11, After(1));
  dut.OnAck({.counter = 11}, After(3));
  EXPECT_EQ(dut.last_round_trip(), Duration(2'000'000));
  dut.OnSent(12, After(4));
  dut.OnAck({.counter = 12, .hold = Duration(500'000)}, After(4.1));
  EXPECT_EQ(dut.last_round_trip(), Duration(0));
}

TEST(SentFrames, EarlierFramesAreNamedButProveNothing) {
  SentFrames dut;
  for (std::uint64_t i = 1; i <= 6; ++i) dut.OnSent(i, After(0.1 * static_cast<double>(i)));
  EXPECT_THAT(
      dut.OnAck({.counter = 5, .earlier = 0b0101, .hold = Duration(50'000), .loss = 0.2}, After(0.65)),
      ElementsAre(2, 4, 5));
  EXPECT_EQ(dut.peer_loss(), 0.2);
  EXPECT_EQ(dut.one_way(), Duration(50'000));  // half of 0.65 - 0.5 - 0.05
}

TEST(SentFrames, WhatWasNeverSentIsNotNamed) {
  SentFrames dut;
  dut.OnSent(100, kStart);
  EXPECT_THAT(dut.OnAck({.counter = 101, .earlier = 0}, After(0.1)), IsEmpty());
  EXPECT_EQ(dut.FormOf(101), CounterForm::kWhole);
}

RC_GTEST_PROP(FrameAck, OnlyFramesThatCameInTheirTurnAreNamed, (std::uint64_t seed)) {
  Rng rng(seed);
  FrameAckSender receiver;
  SentFrames sender;
  std::set<std::uint64_t> in_turn;
  std::uint64_t highest = 0;
  for (std::uint64_t counter = 1; counter < 300; ++counter) {
    sender.OnSent(counter, kStart);
    if (rng.Chance(0.3)) continue;
    receiver.OnFrame(counter - highest);
    highest = counter;
    in_turn.insert(counter);
    if (rng.Chance(0.5)) receiver.OnFrame(0);  // one that was overtaken
    if (!rng.Chance(0.4)) continue;
    const auto named = sender.OnAck(receiver.Take(highest, kStart, 0, kStart), kStart);
    RC_ASSERT(!named.empty() && named.back() == highest);
    for (const std::uint64_t n : named) RC_ASSERT(in_turn.contains(n));
    for (std::uint64_t n = highest > 4 ? highest - 4 : 1; n <= highest; ++n)
      RC_ASSERT(in_turn.contains(n) == (std::count(named.begin(), named.end(), n) == 1));
  }
}

}  // namespace
}  // namespace priamos::bus::radio
