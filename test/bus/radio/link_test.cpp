#include "bus/radio/link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;
using testing::Gt;
using testing::Lt;

TEST(Link, StateArrivesWithinAFrameTime) {
  LinkPair dut;
  dut.Run(0.5);
  const Time offered = dut.now;
  dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
  ASSERT_TRUE(dut.RunUntil(1, [&] { return !dut.offboard.received.empty(); }));
  EXPECT_EQ(ToText(dut.offboard.received[0].delivery.packed), "0123456789");
  EXPECT_LT(Seconds(dut.now - offered), 0.045);
}

TEST(Link, ComesUpFromNothingInAQuarterSecond) {
  LinkPair dut;
  EXPECT_TRUE(dut.RunUntil(
      0.25, [&] { return dut.onboard.link->Status(dut.now).up && dut.offboard.link->Status(dut.now).up; }));
}

TEST(Link, BothDirectionsAtOnce) {
  LinkPair dut;
  dut.each_step = [&] {
    dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
    dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  };
  dut.Run(5);
  EXPECT_NEAR(static_cast<double>(dut.offboard.TextsOf(kPoseUp).size()), 48, 3);
  EXPECT_NEAR(static_cast<double>(dut.onboard.TextsOf(kDriveDown).size()), 96, 5);
}

TEST(Link, WhatIsNotOutgoingIsNotTaken) {
  LinkPair dut;
  EXPECT_EQ(dut.onboard.link->Offer(kDriveDown, Text("abcde"), dut.now), OfferResult::kNotOutgoing);
  EXPECT_EQ(dut.onboard.link->Offer(99, Text("abcde"), dut.now), OfferResult::kNotOutgoing);
}

TEST(Link, LargeEventArrivesWhole) {
  LinkPair dut;
  std::string text;
  for (int i = 0; i < 1400; ++i) text += static_cast<char>(i * 7);
  dut.offboard.link->Offer(kEventDown, Text(text), dut.now);
  ASSERT_TRUE(dut.RunUntil(4, [&] { return !dut.onboard.received.empty(); }));
  EXPECT_EQ(dut.onboard.TextsOf(kEventDown), std::vector{text});
}

TEST(Link, NeverMoreThanAFewBytesAheadOfTheLine) {
  LinkPair dut;
  dut.each_step = [&] {
    dut.onboard.link->Offer(kSlowUp, Text(std::string(100, 'x')), dut.now);
    dut.onboard.link->Offer(kEventUp, Text(std::string(50, 'y')), dut.now);
    EXPECT_LE(dut.line_up.free_at() - dut.now, Duration(3 * 1042));
  };
  dut.Run(3);
}

TEST(Link, AgeOfAMessageIsKnownWithoutACommonClock) {
  LinkPair dut(LineConfig{.latency_s = 0.1});
  dut.Run(2);  // enough to learn the latency
  Time packed_at{};
  dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
  packed_at = dut.now;
  dut.offboard.received.clear();
  ASSERT_TRUE(dut.RunUntil(1, [&] { return !dut.offboard.received.empty(); }));
  EXPECT_NEAR(Seconds(dut.offboard.received[0].delivery.packed_at - packed_at), 0, 0.02);
}

TEST(Link, SilenceIsDownAndFramesAreUp) {
  LineConfig line;
  line.cuts = {{1, 4}};
  LinkPair dut(line);
  dut.Run(0.9);
  EXPECT_TRUE(dut.onboard.link->Status(dut.now).up);
  dut.Run(2.5);
  EXPECT_FALSE(dut.onboard.link->Status(dut.now).up);
  dut.Run(1.0);
  EXPECT_TRUE(dut.onboard.link->Status(dut.now).up);
}

TEST(Link, UrgentAbortsTheFrameInFlight) {
  LinkPair dut(LineConfig{.latency_s = 0});
  dut.Run(1);
  dut.offboard.link->Offer(kEventDown, Text(std::string(700, 'x')), dut.now);
  dut.Run(0.05);
  const Time offered = dut.now;
  dut.offboard.link->Offer(kStopDown, Text("!"), dut.now);
  ASSERT_TRUE(dut.RunUntil(1, [&] { return !dut.onboard.TextsOf(kStopDown).empty(); }));
  EXPECT_LT(Seconds(dut.now - offered), 0.020);
  EXPECT_EQ(dut.offboard.link->Status(dut.now).counters.frames_aborted, 1U);
  ASSERT_TRUE(dut.RunUntil(3, [&] { return !dut.onboard.TextsOf(kEventDown).empty(); }));
  EXPECT_EQ(dut.onboard.TextsOf(kEventDown), std::vector{std::string(700, 'x')});
}

TEST(Link, UrgentAbortsTheRepetitionOfAnotherUrgent) {
  LinkPair dut(LineConfig{.latency_s = 0});
  dut.Run(1);
  // Nothing comes back, so that stops are sent again and again.
  dut.lose_up = [](std::span<const std::byte>) { return true; };
  dut.offboard.link->Offer(kStopDown, Text("1"), dut.now);
  dut.Run(0.1);
  ASSERT_EQ(dut.onboard.TextsOf(kStopDown).size(), 1U);
  for (char c = '2'; c < '9'; ++c) {
    const std::uint64_t resent = dut.offboard.link->Status(dut.now).resent;
    ASSERT_TRUE(dut.RunUntil(5, [&] { return dut.offboard.link->Status(dut.now).resent > resent; }));
    dut.Run(0.003);  // in the midst of the repetition
    dut.offboard.link->Offer(kStopDown, Text(std::string(1, c)), dut.now);
    dut.Run(0.035);  // 29 bytes, a block: in the silence of the other end counters are written whole
    ASSERT_EQ(dut.onboard.TextsOf(kStopDown).size(), static_cast<std::size_t>(c - '0'));
  }
}

TEST(Link, EventsSurviveARestartOfTheSender) {
  LinkPair dut;
  dut.Run(0.5);
  dut.onboard.link->Offer(kEventUp, Text("one"), dut.now);
  dut.onboard.link->Offer(kEventUp, Text("two"), dut.now);
  dut.Start(dut.onboard);  // nothing had been sent
  dut.Run(2);
  dut.onboard.link->Offer(kEventUp, Text("three"), dut.now);
  dut.Run(2);
  EXPECT_THAT(dut.offboard.TextsOf(kEventUp), ElementsAre("one", "two", "three"));
}

TEST(Link, EventsSurviveARestartOfTheReceiver) {
  LinkPair dut;
  dut.Run(0.5);
  dut.onboard.link->Offer(kEventUp, Text(std::string(500, 'a')), dut.now);
  dut.Run(0.3);  // half of it has arrived
  EXPECT_TRUE(dut.offboard.TextsOf(kEventUp).empty());
  dut.Start(dut.offboard);
  dut.onboard.link->Offer(kEventUp, Text("b"), dut.now);
  dut.Run(4);
  EXPECT_THAT(dut.offboard.TextsOf(kEventUp), ElementsAre(std::string(500, 'a'), "b"));
}

TEST(Link, FirstFrameAfterARestartIsUsed) {
  LinkPair dut;
  dut.Run(1);
  dut.Start(dut.onboard);
  dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
  dut.offboard.received.clear();
  ASSERT_TRUE(dut.RunUntil(0.06, [&] { return !dut.offboard.received.empty(); }));
  EXPECT_EQ(dut.onboard.link->Status(dut.now).counters.hellos_sent, 0U);
}

TEST(Link, ARestartedReceiverHearsAgainWithinASecond) {
  LinkPair dut;
  dut.each_step = [&] { dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now); };
  dut.Run(1);
  dut.Start(dut.offboard);
  dut.offboard.received.clear();
  EXPECT_TRUE(dut.RunUntil(1, [&] { return !dut.offboard.received.empty(); }));
}

TEST(Link, LostStateOfEitherOrBothEndsHeals) {
  for (const int who : {1, 2, 3}) {
    LinkPair dut;
    dut.each_step = [&] {
      dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
      dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
    };
    dut.onboard.link->Offer(kEventUp, Text("before"), dut.now);
    dut.Run(2);
    for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) {
      if ((who & (end == &dut.onboard ? 1 : 2)) == 0) continue;
      end->store.Lose();
      dut.Start(*end);
    }
    dut.onboard.link->Offer(kEventUp, Text("after"), dut.now);
    dut.Run(4);
    EXPECT_THAT(dut.offboard.TextsOf(kEventUp), ElementsAre("before", "after")) << who;
    EXPECT_THAT(dut.onboard.TextsOf(kDriveDown).size(), Gt(60U)) << who;
    EXPECT_THAT(dut.offboard.TextsOf(kPoseUp).size(), Gt(35U)) << who;
  }
}

TEST(Link, AnotherTableIsReportedAndNothingIsDelivered) {
  LinkPair dut;
  dut.offboard.channels[kPoseUp].fixed_bits = 88;
  dut.Start(dut.offboard);
  dut.each_step = [&] { dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now); };
  dut.Run(5);
  EXPECT_TRUE(dut.onboard.link->Status(dut.now).table_mismatch);
  EXPECT_TRUE(dut.offboard.link->Status(dut.now).table_mismatch);
  EXPECT_TRUE(dut.offboard.received.empty());
}

TEST(Link, CarriesMessagesWithEveryLengthOfItsCodes) {
  for (const std::size_t code_bytes : {4U, 6U, 8U}) {
    LinkPair dut;
    for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) {
      end->code_bytes = code_bytes;
      dut.Start(*end);
    }
    dut.each_step = [&] {
      dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
      dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
    };
    dut.Run(5);
    EXPECT_THAT(dut.offboard.TextsOf(kPoseUp).size(), Gt(35U)) << code_bytes;
    EXPECT_THAT(dut.onboard.TextsOf(kDriveDown).size(), Gt(60U)) << code_bytes;
    EXPECT_EQ(dut.onboard.link->Status(dut.now).peer_code_bytes, code_bytes);
    EXPECT_EQ(dut.onboard.link->Status(dut.now).counters.rejected, (std::array<std::uint64_t, kRejects>{}));
  }
}

TEST(Link, EndsWithOtherLengthsOfTheirCodesTellEachOtherAndExchangeNothing) {
  LinkPair dut;
  dut.offboard.code_bytes = 8;
  dut.Start(dut.offboard);
  dut.each_step = [&] {
    dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
    dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  };
  dut.Run(5);
  EXPECT_TRUE(dut.onboard.link->Status(dut.now).table_mismatch);
  EXPECT_EQ(dut.onboard.link->Status(dut.now).peer_code_bytes, 8U);
  EXPECT_TRUE(dut.offboard.link->Status(dut.now).table_mismatch);
  EXPECT_EQ(dut.offboard.link->Status(dut.now).peer_code_bytes, 4U);
  EXPECT_TRUE(dut.onboard.received.empty());
  EXPECT_TRUE(dut.offboard.received.empty());
}

TEST(Link, AnotherKeyGetsNothing) {
  LinkPair dut;
  dut.offboard.key[7] = 1;
  dut.Start(dut.offboard);
  dut.each_step = [&] { dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now); };
  dut.Run(5);
  EXPECT_TRUE(dut.offboard.received.empty());
  EXPECT_FALSE(dut.offboard.link->Status(dut.now).up);
}

TEST(Link, CommandOlderThanItsTimeToLiveIsNotDelivered) {
  LinkPair dut(LineConfig{.latency_s = 0.3});
  dut.Run(2);
  dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  dut.Run(1);
  EXPECT_TRUE(dut.onboard.TextsOf(kDriveDown).empty());
  EXPECT_EQ(dut.onboard.link->delivered(kDriveDown).late, 1U);
}

TEST(Link, CommandHeldBackOnTheWayIsNotDelivered) {
  LinkPair dut;
  dut.Run(2);
  std::vector<std::byte> held;
  dut.wire_down.clear();
  dut.lose_down = [](std::span<const std::byte>) { return true; };
  dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  dut.Run(0.1);
  held = dut.wire_down;
  for (const bool overtaken : {false, true}) {
    if (overtaken) dut.lose_down = nullptr;
    dut.Run(2);
    dut.onboard.link->Receive(held, dut.now);
    dut.Run(0.1);
    EXPECT_TRUE(dut.onboard.TextsOf(kDriveDown).empty());
  }
  dut.offboard.link->Offer(kDriveDown, Text("fresh"), dut.now);
  dut.Run(0.5);
  EXPECT_THAT(dut.onboard.TextsOf(kDriveDown), ElementsAre("fresh"));
}

TEST(Link, CommandWhoseDelimiterWasLostIsNotDeliveredByALaterOne) {
  for (const double late_s : {0.05, 0.5}) {
    LinkPair dut(LineConfig{.latency_s = 0});
    dut.Run(2);
    dut.wire_down.clear();
    dut.lose_down = [](std::span<const std::byte>) { return true; };
    dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
    dut.Run(0.05);
    auto frame = dut.wire_down;
    ASSERT_EQ(frame.back(), kDelimiter);
    frame.pop_back();
    EXPECT_TRUE(dut.onboard.link->Receive(frame, dut.now).empty());
    dut.now += FromSeconds(late_s);
    const auto deliveries = dut.onboard.link->Receive(std::vector{kDelimiter}, dut.now);
    EXPECT_EQ(deliveries.size(), late_s < 0.25 ? 1U : 0U);
    EXPECT_EQ(dut.onboard.link->delivered(kDriveDown).late, late_s < 0.25 ? 0U : 1U);
  }
}

TEST(Link, CommandSaysHowLongItHolds) {
  LinkPair dut(LineConfig{.latency_s = 0.05});
  dut.Run(2);
  const Time offered = dut.now;
  dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  dut.Run(1);
  ASSERT_EQ(dut.onboard.received.size(), 1U);
  // There and back, what is written ahead, what the offset loses, and silence beyond its range.
  const double holds_s = Seconds(*dut.onboard.received[0].delivery.valid_until - offered);
  EXPECT_LE(holds_s, 0.25);
  EXPECT_GT(holds_s, 0.25 - 0.05 - 0.25 / 32 - 0.03);
}

TEST(Link, EncryptedLinkWorks) {
  LinkPair dut;
  dut.encrypted = true;
  dut.Start(dut.onboard);
  dut.Start(dut.offboard);
  dut.onboard.link->Offer(kEventUp, Text("a secret that is long enough"), dut.now);
  dut.Run(2);
  EXPECT_THAT(dut.offboard.TextsOf(kEventUp), ElementsAre("a secret that is long enough"));
  EXPECT_EQ(ToText(dut.wire_up).find("secret"), std::string::npos);
}

TEST(Link, EventsOnceAndInOrderWithThirtyPercentLoss) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    LinkPair dut({}, seed);
    Rng loss = Rng::Stream(seed, "loss");
    dut.lose_up = dut.lose_down = [&](std::span<const std::byte>) { return loss.Chance(0.3); };
    std::vector<std::string> sent;
    for (int i = 0; i < 40; ++i) {
      sent.push_back("event " + std::to_string(i) + std::string(static_cast<std::size_t>(i * 3), '.'));
      dut.onboard.link->Offer(kEventUp, Text(sent.back()), dut.now);
      dut.Run(0.2);
    }
    dut.Run(10);
    EXPECT_EQ(dut.offboard.TextsOf(kEventUp), sent) << seed;
  }
}

}  // namespace
}  // namespace priamos::bus::radio
