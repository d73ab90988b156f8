#include "bus/radio/channels/send_queue.hpp"

#include <gtest/gtest.h>

#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kAgeing{1'000'000};

Time After(double s) {
  return kStart + FromSeconds(s);
}

struct SendQueueTest : testing::Test {
  std::vector<LinkChannel> channels = TestChannels();
  ChannelTable Table() const { return {channels, false}; }
};

TEST_F(SendQueueTest, NewestWins) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kPoseUp, "", Text("old"), kStart);
  dut.Offer(kPoseUp, "", Text("new"), After(0.1));
  const auto ready = dut.Ready(After(0.1));
  ASSERT_EQ(ready.size(), 1U);
  EXPECT_EQ(ToText(dut.Take(ready[0]).encoded), "new");
  EXPECT_EQ(dut.counters(kPoseUp).replaced, 1U);
  EXPECT_TRUE(dut.Ready(After(0.1)).empty());
}

TEST_F(SendQueueTest, KeysDoNotReplaceEachOther) {
  channels[kSlowUp].max_keys = 2;
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  EXPECT_TRUE(dut.Offer(kSlowUp, "robot", Text("r"), kStart));
  EXPECT_TRUE(dut.Offer(kSlowUp, "head", Text("h"), kStart));
  EXPECT_FALSE(dut.Offer(kSlowUp, "world", Text("w"), kStart));
  EXPECT_EQ(dut.Ready(kStart).size(), 2U);
  EXPECT_EQ(dut.counters(kSlowUp).refused, 1U);
}

TEST_F(SendQueueTest, PriorityDecides) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kSlowUp, "", Text("s"), kStart);
  dut.Offer(kPoseUp, "", Text("p"), kStart);
  EXPECT_EQ(dut.Ready(kStart)[0].channel, kPoseUp);
}

TEST_F(SendQueueTest, WaitingRaisesThePriority) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kSlowUp, "", Text("s"), kStart);  // priority 5 against 2
  dut.Offer(kPoseUp, "", Text("p"), After(2.9));
  EXPECT_EQ(dut.Ready(After(2.9))[0].channel, kPoseUp);
  dut.Offer(kPoseUp, "", Text("p"), After(3.0));
  EXPECT_EQ(dut.Ready(After(3.0))[0].channel, kSlowUp);
}

TEST_F(SendQueueTest, AnEndlesslyReplacedMessageAgesAllTheSame) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  for (int i = 0; i <= 40; ++i) dut.Offer(kSlowUp, "", Text("s"), After(0.1 * i));
  dut.Offer(kPoseUp, "", Text("p"), After(4));
  EXPECT_EQ(dut.Ready(After(4))[0].channel, kSlowUp);
}

TEST_F(SendQueueTest, UrgentGoesFirstWhateverWaits) {
  channels[kSlowUp].urgent = true;
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kPoseUp, "", Text("p"), kStart);
  EXPECT_FALSE(dut.UrgentReady(kStart));
  dut.Offer(kSlowUp, "", Text("s"), After(0.1));
  EXPECT_TRUE(dut.UrgentReady(After(0.1)));
  EXPECT_EQ(dut.Ready(After(0.1))[0].channel, kSlowUp);
}

/// Numbers of the segments that would be sent at `now`, one after the other.
std::vector<int> SendAll(SendQueue& dut, std::size_t channel, Time now) {
  std::vector<int> numbers;
  while (const auto segment = dut.PeekEvent(channel, now)) {
    numbers.push_back(segment->number);
    dut.TakeEvent(channel, segment->number, now, now);
  }
  return numbers;
}

TEST_F(SendQueueTest, UrgentGoesBeforeTheRepetitionOfAnother) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kDown, kAgeing);
  dut.OfferEvent(kStopDown, Text("1"), 8, kStart);
  EXPECT_EQ(SendAll(dut, kStopDown, kStart), std::vector({0}));
  EXPECT_FALSE(dut.RepetitionReady(kStart)) << "once per frame";
  EXPECT_TRUE(dut.RepetitionReady(After(0.01)));
  EXPECT_FALSE(dut.UrgentReady(After(0.01)));
  dut.OfferEvent(kStopDown, Text("2"), 8, After(0.01));
  EXPECT_FALSE(dut.IsRepetition(kStopDown, After(0.01)));
  EXPECT_TRUE(dut.UrgentReady(After(0.01)));
  EXPECT_EQ(SendAll(dut, kStopDown, After(0.01)), std::vector({1, 0}));
}

TEST_F(SendQueueTest, AnAcknowledgedEventIsNotRepeated) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kDown, kAgeing);
  RoundTrip round_trip;
  dut.OfferEvent(kStopDown, Text("1"), 8, kStart);
  dut.OfferEvent(kEventDown, Text("event"), 40, kStart);
  SendAll(dut, kStopDown, kStart);
  SendAll(dut, kEventDown, kStart);
  EXPECT_FALSE(dut.IsRepetition(kEventDown, After(9))) << "its timeout is over, but it is not urgent";
  dut.events(kStopDown).OnAck({.next = 1}, After(0.02), round_trip);
  EXPECT_FALSE(dut.RepetitionReady(After(9)));
}

TEST_F(SendQueueTest, UrgentEventIsNeverHeldBackByItsRate) {
  channels[kStopDown].rate_hz = 0.1;
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kDown, kAgeing);
  for (const char* text : {"1", "2", "3"}) dut.OfferEvent(kStopDown, Text(text), 8, kStart);
  EXPECT_TRUE(dut.UrgentReady(kStart));
  EXPECT_EQ(SendAll(dut, kStopDown, kStart), std::vector({0, 1, 2}));
}

TEST_F(SendQueueTest, RateIsKept) {
  channels[kPoseUp].ttl = Duration::zero();
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  int sent = 0;
  for (int i = 0; i < 1000; ++i) {
    dut.Offer(kPoseUp, "", Text("p"), After(0.01 * i));
    for (const auto& candidate : dut.Ready(After(0.01 * i))) {
      dut.Take(candidate);
      ++sent;
    }
  }
  EXPECT_NEAR(sent, 100, 1);  // 10 Hz for 10 s
}

TEST_F(SendQueueTest, HeldCommandsAreNotReadyAlsoUrgentOnes) {
  channels[kDriveDown].urgent = true;
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kDown, kAgeing);
  dut.Offer(kDriveDown, "", Text("abcde"), kStart);
  dut.OfferEvent(kEventDown, Text("event"), 40, kStart);
  dut.HoldCommands(true);
  ASSERT_EQ(dut.Ready(kStart).size(), 1U);
  EXPECT_EQ(dut.Ready(kStart)[0].channel, kEventDown);
  EXPECT_FALSE(dut.UrgentReady(kStart));
  dut.HoldCommands(false);
  EXPECT_EQ(dut.Ready(kStart).size(), 2U);
  EXPECT_TRUE(dut.UrgentReady(kStart));
}

TEST_F(SendQueueTest, ExpiredIsDroppedAndCounted) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kPoseUp, "", Text("p"), kStart);
  dut.Expire(After(0.5));
  EXPECT_EQ(dut.Ready(After(0.5)).size(), 1U);
  dut.Expire(After(0.501));
  EXPECT_TRUE(dut.Ready(After(0.501)).empty());
  EXPECT_EQ(dut.counters(kPoseUp).expired, 1U);
}

TEST_F(SendQueueTest, TheTimeToLiveCountsFromWhenAMessageWasMade) {
  const ChannelTable table = Table();  // 0.25 s
  SendQueue dut(table, Direction::kDown, kAgeing);
  EXPECT_TRUE(dut.Offer(kDriveDown, "", Text("late "), After(1), After(0.749)));
  EXPECT_TRUE(dut.Offer(kDriveDown, "", Text("never"), After(1), Time::min()));
  EXPECT_TRUE(dut.Ready(After(1)).empty());
  EXPECT_EQ(dut.counters(kDriveDown).expired, 2U);
  dut.Offer(kDriveDown, "", Text("abcde"), After(1), After(0.8));
  dut.Expire(After(1.05));
  EXPECT_EQ(dut.Ready(After(1.05)).size(), 1U);
  dut.Expire(After(1.051));
  EXPECT_TRUE(dut.Ready(After(1.051)).empty());
  EXPECT_EQ(dut.counters(kDriveDown).expired, 3U);
}

TEST_F(SendQueueTest, OneMadeInTheFutureLivesNoLongerThanOneOfNow) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kDown, kAgeing);
  dut.Offer(kDriveDown, "", Text("abcde"), kStart, Time::max());
  EXPECT_EQ(dut.MadeAt(dut.Ready(kStart).at(0)), kStart);
  dut.Expire(After(0.251));
  EXPECT_TRUE(dut.Ready(After(0.251)).empty());
  dut.Offer(kDriveDown, "", Text("again"), After(0.3));  // nor does it hold later ones back
  EXPECT_EQ(dut.Ready(After(0.3)).size(), 1U);
}

TEST_F(SendQueueTest, AnOlderOneThatCameLateFollowsNoNewerOne) {
  const ChannelTable table = Table();
  for (const bool sent : {false, true}) {
    SendQueue dut(table, Direction::kDown, kAgeing);
    dut.Offer(kDriveDown, "", Text("newer"), After(0.2));
    if (sent) dut.Take(dut.Ready(After(0.2)).at(0));
    EXPECT_TRUE(dut.Offer(kDriveDown, "", Text("older"), After(0.3), After(0.1)));
    EXPECT_EQ(dut.counters(kDriveDown).expired, 1U);
    EXPECT_EQ(dut.Ready(After(0.3)).size(), sent ? 0U : 1U);
    dut.Offer(kDriveDown, "", Text("close"), After(0.3), After(0.195));
    EXPECT_EQ(ToText(dut.Peek(dut.Ready(After(0.3)).at(0))), "close");
  }
}

TEST_F(SendQueueTest, WhatWasLateHasNoCreditForIt) {
  const ChannelTable table = Table();  // 20 Hz, one at once
  SendQueue dut(table, Direction::kDown, kAgeing);
  int taken = 0;
  for (int ms = 1000; ms < 2000; ++ms) {
    const Time now = After(0.001 * ms);
    dut.Offer(kDriveDown, "", Text("abcde"), now, now - FromSeconds(ms % 2 == 0 ? 0.24 : 0.235));
    if (dut.Ready(now).empty()) continue;
    dut.Take(dut.Ready(now)[0]);
    ++taken;
  }
  EXPECT_LE(taken, 21);
  EXPECT_GE(taken, 20);
}

TEST_F(SendQueueTest, ReturnedAfterAnAbortUnlessANewerOneCame) {
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kPoseUp, "", Text("1"), kStart);
  dut.Return(dut.Take(dut.Ready(kStart)[0]));
  ASSERT_EQ(dut.Ready(kStart).size(), 1U);  // the rate is given back as well
  auto taken = dut.Take(dut.Ready(kStart)[0]);
  dut.Offer(kPoseUp, "", Text("2"), After(0.05));
  dut.Return(std::move(taken));
  ASSERT_EQ(dut.Ready(After(0.05)).size(), 1U);
  EXPECT_EQ(ToText(dut.Peek(dut.Ready(After(0.05))[0])), "2");
}

TEST_F(SendQueueTest, OnRequestWaitsForAListener) {
  channels[kPoseUp].on_request = true;
  const ChannelTable table = Table();
  SendQueue dut(table, Direction::kUp, kAgeing);
  dut.Offer(kPoseUp, "", Text("p"), kStart);
  EXPECT_TRUE(dut.Ready(kStart).empty());
  EXPECT_EQ(dut.counters(kPoseUp).unwanted, 1U);
  dut.SetWanted(kPoseUp, true);
  dut.Offer(kPoseUp, "", Text("p"), kStart);
  EXPECT_EQ(dut.Ready(kStart).size(), 1U);
}

TEST(RateLimit, AllowsABurstThenTheRate) {
  RateLimit dut(2, 3);
  int allowed = 0;
  for (int i = 0; i < 5; ++i) {
    if (!dut.Allows(kStart)) continue;
    dut.Use(kStart);
    ++allowed;
  }
  EXPECT_EQ(allowed, 3);
  EXPECT_FALSE(dut.Allows(After(0.49)));
  EXPECT_TRUE(dut.Allows(After(0.5)));
}

TEST(RateLimit, WaitingForTheLineDoesNotSlowItDown) {
  RateLimit dut(10, 1);
  dut.Use(kStart);  // sent late, at 0.09 s
  EXPECT_TRUE(dut.Allows(After(0.1)));
}

}  // namespace
}  // namespace priamos::bus::radio
