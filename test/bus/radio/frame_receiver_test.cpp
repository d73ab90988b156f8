#include "bus/radio/frame_receiver.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
Time After(double s) {
  return kStart + FromSeconds(s);
}

constexpr std::uint64_t kEpoch = 5;
constexpr FrameScope kScope{.table_hash = 9};
const LinkKey kKey{1, 2, 3};

std::vector<std::byte> Sealed(std::uint64_t counter, const std::string& bundle, LinkKey key = kKey) {
  return FrameSealer(FrameKeys(key), Direction::kUp, kScope)
      .Seal(kEpoch, counter, CounterForm::kWhole, Text(bundle));
}

struct FrameReceiverTest : testing::Test {
  /// What the last byte makes complete.
  FrameReceiver::Result Push(std::span<const std::byte> bytes, Time now) {
    FrameReceiver::Result result;
    for (const std::byte b : bytes) result = dut.Push(b, now);
    return result;
  }
  FrameReceiver dut = [] {
    FrameReceiver receiver(FrameKeys(kKey), Direction::kUp, kScope, 960, FromSeconds(1.5), kStart);
    receiver.SetEpoch(kEpoch, 0);
    return receiver;
  }();
};

TEST_F(FrameReceiverTest, AFrameComesWithWhereAndWhenItCame) {
  const auto wire = Sealed(3, "bundle");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Push(std::span(wire).first(4), After(1))));
  const auto result = Push(std::span(wire).subspan(4), After(1.1));
  const auto& accepted = std::get<AcceptedFrame>(result);
  EXPECT_EQ(ToText(accepted.frame.bundle), "bundle");
  EXPECT_EQ(accepted.ahead, 3U);
  EXPECT_EQ(accepted.wire_bytes, wire.size());
  EXPECT_EQ(accepted.first_byte, After(1));
  EXPECT_TRUE(accepted.link_back);
  EXPECT_EQ(dut.heard_at(), After(1.1));
  EXPECT_EQ(dut.counters().bytes, wire.size());
}

TEST_F(FrameReceiverTest, ABlockIsAFrameAlsoWhereTheStreamIsCutAtDelimiters) {
  auto wire = FrameSealer(FrameKeys(kKey), Direction::kUp, kScope)
                  .Seal(kEpoch, 3, CounterForm::kWhole, Text("x"), 0, LineCode::kBlock);
  wire.pop_back();
  wire[2] ^= std::byte{0x10};
  const auto result = dut.Take(wire, After(1), After(1.1), 0, false);
  ASSERT_TRUE(std::holds_alternative<AcceptedFrame>(result));
  EXPECT_EQ(std::get<AcceptedFrame>(result).frame.counter, 3U);
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kMalformed)], 0U);
}

TEST_F(FrameReceiverTest, ABlockIsAFrameLikeAnother) {
  const auto wire = FrameSealer(FrameKeys(kKey), Direction::kUp, kScope)
                        .Seal(kEpoch, 3, CounterForm::kWhole, Text("x"), 0, LineCode::kBlock);
  Push(std::span(wire).first(4), After(1));
  const auto result = Push(std::span(wire).subspan(4), After(1.1));
  const auto& accepted = std::get<AcceptedFrame>(result);
  EXPECT_EQ(accepted.frame.counter, 3U);
  EXPECT_EQ(accepted.wire_bytes, wire.size());
  EXPECT_EQ(accepted.first_byte, After(1));
  EXPECT_EQ(dut.newest()->line_code, LineCode::kBlock);
  EXPECT_EQ(dut.counters().rejected, ReceptionCounters{}.rejected);
  Push(wire, After(1.2));
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kReplayed)], 1U);
}

TEST_F(FrameReceiverTest, ABlockOfAnotherKeyIsAForgery) {
  const auto wire = FrameSealer(FrameKeys(LinkKey{9}), Direction::kUp, kScope)
                        .Seal(kEpoch, 3, CounterForm::kWhole, Text("x"), 0, LineCode::kBlock);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Push(wire, After(1))));
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kBadCode)], 1U);
}

TEST_F(FrameReceiverTest, UnderTheNextKeyHellosAreOpenedAndNoData) {
  const LinkKey next{9};
  const FrameSealer sealer(FrameKeys(next), Direction::kUp, kScope);
  const auto hello = sealer.Seal(Hello{.nonce = 5}), data = Sealed(3, "x", next);
  Push(hello, After(1));
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kBadCode)], 1U) << "no next key yet";
  dut.SetNextKey(FrameOpener(FrameKeys(next), Direction::kUp, kScope));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Push(data, After(2))));
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kBadCode)], 2U);
  EXPECT_EQ(std::get<NextKeyHello>(Push(hello, After(3))).hello.nonce, 5U);
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kBadCode)], 2U);
}

TEST_F(FrameReceiverTest, OnceTheNextKeyIsUsedTheOneBeforeOpensNothing) {
  const LinkKey next{9};
  dut.SetNextKey(FrameOpener(FrameKeys(next), Direction::kUp, kScope));
  dut.UseNextKey();
  dut.SetEpoch(kEpoch, 0);
  const auto hello = FrameSealer(FrameKeys(kKey), Direction::kUp, kScope).Seal(Hello{.nonce = 5});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Push(hello, After(1))));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Push(Sealed(3, "x"), After(2))));
  EXPECT_TRUE(std::holds_alternative<AcceptedFrame>(Push(Sealed(3, "x", next), After(3))));
}

TEST_F(FrameReceiverTest, WhatWasMissedCountsOnlyBetweenFramesOfThisLife) {
  Push(Sealed(10, "a"), After(0));
  EXPECT_EQ(dut.counters().missed, 0U);
  Push(Sealed(13, "b"), After(0.1));
  EXPECT_EQ(dut.counters().missed, 2U);
  const auto overtaken = Push(Sealed(12, "c"), After(0.2));
  EXPECT_EQ(std::get<AcceptedFrame>(overtaken).ahead, 0U);
  EXPECT_EQ(dut.counters().missed, 2U);
  EXPECT_EQ(dut.highest(), 13U);
  EXPECT_GT(dut.loss().loss(), 0);
}

TEST_F(FrameReceiverTest, TheNewestFrameIsThatOfTheHighestCounterInThisEpoch) {
  EXPECT_FALSE(dut.newest());
  Push(Sealed(10, "a"), After(1));
  Push(Sealed(9, "b"), After(1.1));  // overtaken
  ASSERT_TRUE(dut.newest());
  EXPECT_EQ(dut.newest()->counter, 10U);
  EXPECT_EQ(dut.newest()->at, After(1));
  dut.SetEpoch(kEpoch + 1, 0);
  EXPECT_FALSE(dut.newest());
}

TEST_F(FrameReceiverTest, SilenceIsDownUntilAFrameComes) {
  EXPECT_EQ(dut.reception(kStart), Reception::kSilent);
  Push(Sealed(1, "a"), After(0));
  EXPECT_EQ(dut.reception(After(1.5)), Reception::kHeard);
  EXPECT_EQ(dut.reception(After(1.6)), Reception::kSilent);
  EXPECT_TRUE(dut.Down(After(1.6)));
  EXPECT_TRUE(std::get<AcceptedFrame>(Push(Sealed(2, "b"), After(1.6))).link_back);
  EXPECT_FALSE(std::get<AcceptedFrame>(Push(Sealed(3, "c"), After(1.7))).link_back);
}

TEST_F(FrameReceiverTest, FramesThatCannotBeUsedAskForAnEpoch) {
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(dut.reception(After(0.1)), Reception::kSilent);
    Push(Sealed(1, "a", LinkKey{7}), After(0.1));
  }
  EXPECT_EQ(dut.reception(After(0.1)), Reception::kUnusable);
  Push(Sealed(1, "a"), After(0.2));
  EXPECT_EQ(dut.reception(After(0.2)), Reception::kHeard);
  dut.SetEpoch(0, 0);
  EXPECT_EQ(dut.reception(After(0.2)), Reception::kUnusable);
}

TEST_F(FrameReceiverTest, EveryRefusalIsCountedByItsReason) {
  const auto rejected = [&](Reject r) { return dut.counters().rejected[static_cast<std::size_t>(r)]; };
  Push(Sealed(1, "a"), kStart);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Push(Sealed(1, "a"), kStart)));
  EXPECT_EQ(rejected(Reject::kReplayed), 1U);
  Push(Sealed(2, "a", LinkKey{7}), kStart);
  EXPECT_EQ(rejected(Reject::kBadCode), 1U);
  auto noise = std::vector<std::byte>(400, std::byte{1});
  noise.push_back(kDelimiter);
  Push(noise, kStart);
  EXPECT_EQ(rejected(Reject::kOversize), 1U);
  Push(std::vector{std::byte{9}, kDelimiter}, kStart);
  EXPECT_EQ(rejected(Reject::kMalformed), 1U);
  dut.SetEpoch(0, 0);
  Push(Sealed(3, "a"), kStart);
  EXPECT_EQ(rejected(Reject::kNoEpoch), 1U);
  for (int i = 0; i < 300; ++i) Push(Sealed(200, "a"), kStart);
  EXPECT_GT(rejected(Reject::kFlood), 0U);
  EXPECT_TRUE(dut.alarm(kStart));
}

/// A frame with a wrong code, as it lies between two delimiters.
std::vector<std::byte> Garbage(std::uint64_t counter) {
  auto wire = Sealed(counter, "bundle", LinkKey{7});
  wire.pop_back();
  return wire;
}

TEST_F(FrameReceiverTest, AFloodOfUnexpectedCountersDoesNotUseUpTheChecksOfTheNextFrame) {
  Push(Sealed(1000, "a"), kStart);
  for (int i = 0; i < 10'000; ++i) dut.Take(Garbage(i % 2 == 0 ? 5 : 5000), kStart, kStart, 0, false);
  EXPECT_GT(dut.counters().rejected[static_cast<std::size_t>(Reject::kFlood)], 9000U);
  EXPECT_TRUE(std::holds_alternative<AcceptedFrame>(Push(Sealed(1001, "b"), kStart)));
}

TEST_F(FrameReceiverTest, AFloodThatLooksRightDoesNotEither) {
  Time now = After(1);
  Push(Sealed(1, "a"), now);
  int accepted = 0;
  for (std::uint64_t counter = 2; counter < 22; ++counter) {  // 20 frames and 10 000 forged ones in a second
    for (int i = 0; i < 500; ++i) {
      now += Duration(100);
      dut.Take(Garbage(counter), now, now, 0, false);
    }
    const auto result = Push(Sealed(counter, "b"), now);
    accepted += std::holds_alternative<AcceptedFrame>(result) ? 1 : 0;
  }
  EXPECT_EQ(accepted, 20);
  EXPECT_TRUE(dut.alarm(now));
}

TEST_F(FrameReceiverTest, StrangersAreCheckedSeldomUntilTheOtherEndIsSilent) {
  Push(Sealed(1, "a"), kStart);
  for (int i = 0; i < 1000; ++i) dut.Take(Garbage(2), kStart, kStart, 0, true);
  EXPECT_EQ(dut.counters().rejected[static_cast<std::size_t>(Reject::kBadCode)], 50U);
  auto moved = Sealed(2, "b");
  moved.pop_back();
  EXPECT_TRUE(std::holds_alternative<std::monostate>(dut.Take(moved, kStart, kStart, 0, true)));
  for (int i = 0; i < 1000; ++i) dut.Take(Garbage(2), After(2), After(2), 0, true);
  EXPECT_TRUE(std::holds_alternative<AcceptedFrame>(dut.Take(moved, After(2), After(2), 0, true)));
}

TEST_F(FrameReceiverTest, AHelloIsPassedOnAndProvesNoReception) {
  const auto wire = FrameSealer(FrameKeys(kKey), Direction::kUp, kScope).Seal(Hello{.nonce = 12});
  EXPECT_EQ(std::get<Hello>(Push(wire, kStart)).nonce, 12U);
  EXPECT_TRUE(dut.Down(kStart));
}

RC_GTEST_PROP(FrameReceiver, NoiseBetweenFramesCostsAtMostTheNextOne, (std::uint64_t seed)) {
  Rng rng(seed);
  FrameReceiver dut(FrameKeys(kKey), Direction::kUp, kScope, 960, FromSeconds(1.5), kStart);
  dut.SetEpoch(kEpoch, 0);
  Time now = kStart;
  for (std::uint64_t counter = 1; counter < 30; counter += 2) {
    std::vector<std::byte> bytes(rng.Below(300));
    for (std::byte& b : bytes) b = static_cast<std::byte>(rng.Below(256));
    const auto glued = Sealed(counter, "glued"), good = Sealed(counter + 1, "good");
    bytes.insert(bytes.end(), glued.begin(), glued.end());
    bytes.insert(bytes.end(), good.begin(), good.end());
    FrameReceiver::Result last;
    for (const std::byte b : bytes) {
      last = dut.Push(b, now);
      now += Duration(1042);
    }
    RC_ASSERT(std::holds_alternative<AcceptedFrame>(last));
    RC_ASSERT(ToText(std::get<AcceptedFrame>(last).frame.bundle) == "good");
  }
}

}  // namespace
}  // namespace priamos::bus::radio
