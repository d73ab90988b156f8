#include "bus/radio/channels/delta.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/random.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const ValueWidths kWidths{15, 15, 13, 9, 1, 3, 64};

std::vector<std::byte> Message(const ValueWidths& widths, const std::vector<std::uint64_t>& values) {
  BitWriter out;
  for (std::size_t i = 0; i < widths.size(); ++i) out.Put(values[i], widths[i]);
  return out.bytes();
}

TEST(Delta, WhatStandsStillCostsABitPerValue) {
  const auto message = Message(kWidths, {1, 2, 3, 4, 1, 6, 7});
  EXPECT_EQ(EncodeDelta(kWidths, message, message).bits(), kWidths.size());
}

TEST(Delta, SmallStepsAreShort) {
  const auto before = Message(kWidths, {1000, 0, 3, 4, 1, 6, 7});
  // 15 bits: 2 and 6 for a step of 32 back; down from 0 it goes on at the top, as a heading does.
  EXPECT_EQ(EncodeDelta(kWidths, before, Message(kWidths, {968, 0, 3, 4, 1, 6, 7})).bits(), 6 + 8U);
  EXPECT_EQ(EncodeDelta(kWidths, before, Message(kWidths, {1032, 0, 3, 4, 1, 6, 7})).bits(), 6 + 17U);
  EXPECT_EQ(EncodeDelta(kWidths, before, Message(kWidths, {1000, 32767, 3, 4, 1, 6, 7})).bits(), 6 + 8U);
}

TEST(Delta, EverythingComesBack) {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    ValueWidths widths(1 + rng.Below(12));
    for (auto& w : widths) w = static_cast<std::uint8_t>(1 + rng.Below(64));
    BitWriter before, now, wire;
    for (const int w : widths) {
      const std::uint64_t value = rng.engine()();
      before.Put(value, w);
      now.Put(rng.Chance(0.7) ? value + rng.Below(40) - 20 : rng.engine()(), w);
    }
    const BitWriter delta = EncodeDelta(widths, before.bytes(), now.bytes());
    EXPECT_EQ(ApplyDelta(widths, before.bytes(), delta.bytes()), now.bytes());
    // Between other bits it is found again without the baseline.
    wire.Put(5, 3);
    wire.Append(delta.bytes(), delta.bits());
    wire.Put(9, 4);
    const std::vector<std::byte> bits = wire.Finish();
    BitReader in(bits);
    in.Get(3);
    EXPECT_EQ(TakeDelta(widths, in), delta.bytes());
    EXPECT_EQ(in.Get(4), 9U);
    EXPECT_TRUE(in.ok());
  }
}

TEST(Delta, AnyBytesAreReadWithoutHarm) {
  Rng rng(2);
  for (int i = 0; i < 100000; ++i) {
    std::vector<std::byte> baseline(rng.Below(20)), delta(rng.Below(20));
    for (std::byte& b : baseline) b = static_cast<std::byte>(rng.Below(256));
    for (std::byte& b : delta) b = static_cast<std::byte>(rng.Below(256));
    const auto message = ApplyDelta(kWidths, baseline, delta);
    if (message) {
      EXPECT_EQ(message->size(), 15U);  // 120 bits
    }
    BitReader in(delta);
    TakeDelta(kWidths, in);
  }
}

TEST(Delta, CounterOfTheBaseline) {
  EXPECT_EQ(BaselineCounter(100, 99 & 63), 99U);
  EXPECT_EQ(BaselineCounter(100, 37), 37U);
  EXPECT_EQ(BaselineCounter(100, 100 & 63), 0U);
  EXPECT_EQ(BaselineCounter(5, 6), 0U);
  EXPECT_EQ(BaselineCounter(1000, 999 & 63), 999U);
}

TEST(DeltaSender, RefersOnlyToWhatWasAcknowledgedAndIsNear) {
  DeltaSender dut;
  dut.OnSent(10, Text("a"));
  dut.OnSent(12, Text("b"));
  EXPECT_EQ(dut.Baseline(13), nullptr);
  dut.OnAcknowledged(11);  // a frame without the channel
  EXPECT_EQ(dut.Baseline(13), nullptr);
  dut.OnAcknowledged(12);
  ASSERT_NE(dut.Baseline(13), nullptr);
  EXPECT_EQ(ToText(dut.Baseline(13)->packed), "b");
  dut.OnAcknowledged(10);  // overtaken
  EXPECT_EQ(dut.Baseline(13)->counter, 12U);
  EXPECT_NE(dut.Baseline(12 + kDeltaReach), nullptr);
  EXPECT_EQ(dut.Baseline(13 + kDeltaReach), nullptr);
  dut.Forget();
  EXPECT_EQ(dut.Baseline(13), nullptr);
  dut.OnAcknowledged(12);
  EXPECT_EQ(dut.Baseline(13), nullptr);
}

// ---- Through the link: a pose that moves a little, on a line that loses, with ends that restart.

const ValueWidths kPoseWidths{16, 16, 16, 32};

struct DeltaLink : testing::Test {
  explicit DeltaLink(bool deltas = true) {
    for (LinkPair::End* end : {&pair.onboard, &pair.offboard}) {
      if (deltas) end->channels[kPoseUp].delta = kPoseWidths;
      pair.Start(*end);
    }
    pair.each_step = [this] { Step(); };
  }
  void Step() {
    if (ToUtime(pair.now) % 50'000 == 0) {
      ++number;
      const std::uint64_t x = 1000 + number * 3;
      sent[number] = Message(kPoseWidths, {x & 0xFFFF, 500, 0x10 + number % 7, number});
      pair.onboard.link->Offer(kPoseUp, sent[number], pair.now);
    }
    for (const LinkPair::Received& r : pair.offboard.received) {
      BitReader in(r.delivery.packed);
      in.Get(48);
      const std::uint64_t id = in.Get(32);
      wrong += sent.count(id) == 0 || sent[id] != r.delivery.packed ? 1 : 0;
      ++arrived;
    }
    pair.offboard.received.clear();
  }
  std::uint64_t BitsSent() const { return pair.onboard.link->sent(kPoseUp).bits; }

  LinkPair pair;
  std::map<std::uint64_t, std::vector<std::byte>> sent;
  std::uint64_t number = 0;
  int arrived = 0, wrong = 0;
};

TEST_F(DeltaLink, SendsLess) {
  pair.Run(2);
  const auto bits = BitsSent(), messages = pair.onboard.link->sent(kPoseUp).sent;
  pair.Run(20);
  const double mean = static_cast<double>(BitsSent() - bits) /
                      static_cast<double>(pair.onboard.link->sent(kPoseUp).sent - messages);
  EXPECT_LT(mean, 40);  // of 80
  EXPECT_GT(arrived, 190);
  EXPECT_EQ(wrong, 0);
}

TEST_F(DeltaLink, SendsLessAlsoWhenAnotherFrameAlwaysComesBeforeTheAcknowledgement) {
  for (LinkPair::End* end : {&pair.onboard, &pair.offboard}) {
    for (const std::size_t channel : {kPoseUp, kSlowUp}) {
      end->channels[channel].rate_hz = 0;
      end->channels[channel].fixed_bits = end->channels[channel].max_bits = 80;
    }
    pair.Start(*end);
  }
  const std::vector<std::byte> same(10);
  pair.each_step = [&] {
    // Acknowledgements are 250 ms apart: only the first of them falls between the pose and what follows it.
    const std::int64_t phase_us = ToUtime(pair.now) % 500'000;
    if (phase_us == 0) pair.onboard.link->Offer(kPoseUp, same, pair.now);
    if (phase_us == 40'000 || phase_us == 290'000) pair.onboard.link->Offer(kSlowUp, same, pair.now);
  };
  pair.Run(60);
  EXPECT_LT(BitsSent() / pair.onboard.link->sent(kPoseUp).sent, 20U);
}

TEST_F(DeltaLink, LossAndRestartsNeverMakeAWrongMessage) {
  Rng rng(4);
  pair.lose_up = pair.lose_down = [&](std::span<const std::byte>) { return rng.Chance(0.3); };
  for (int i = 0; i < 60; ++i) {
    pair.Run(2);
    if (rng.Chance(0.2)) pair.Start(pair.onboard);
    if (rng.Chance(0.2)) pair.Start(pair.offboard);
    if (rng.Chance(0.1)) pair.offboard.store.Lose();
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(arrived, 400);
}

TEST_F(DeltaLink, AReceiverThatRestartedGetsWholeMessagesSoon) {
  for (int i = 0; i < 20; ++i) {
    pair.Run(3);
    pair.Start(pair.offboard);
    pair.Run(0.6);
    const int before = arrived;
    pair.Run(1);
    EXPECT_GE(arrived - before, 8) << i;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(DeltaTable, BothEndsMustAgree) {
  auto channels = TestChannels();
  const auto plain = ChannelTable(channels, false).hash();
  channels[kPoseUp].delta = kPoseWidths;
  const auto with = ChannelTable(channels, false).hash();
  channels[kPoseUp].delta = {16, 16, 32, 16};
  EXPECT_NE(plain, with);
  EXPECT_NE(with, ChannelTable(channels, false).hash());
}

TEST(DeltaTable, OnlyForStatesOfFixedSize) {
  for (const std::size_t channel : {kEventUp, kDriveDown, kStopDown}) {
    auto channels = TestChannels();
    channels[channel].delta = {8};
    EXPECT_THROW(ChannelTable(channels, false), std::invalid_argument) << channel;
  }
  auto channels = TestChannels();
  channels[kPoseUp].delta = {16, 16};
  EXPECT_THROW(ChannelTable(channels, false), std::invalid_argument);
}

}  // namespace
}  // namespace priamos::bus::radio
