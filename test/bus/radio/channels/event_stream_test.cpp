#include "bus/radio/channels/event_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "common/random.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kOverdue{10'000'000};

bool Offer(EventSender& sender, const std::string& text, Time now = kStart) {
  return sender.Offer(Text(text), 8 * text.size(), now);
}

/// Sends everything that is due, as one frame that arrives at once.
std::vector<std::string> Exchange(EventSender& sender, EventReceiver& receiver, Time now) {
  std::vector<std::string> texts;
  while (const auto segment = sender.Next(now)) {
    sender.MarkSent(segment->number, now, now);
    for (const auto& event : receiver.OnSegment(*segment, now)) texts.push_back(ToText(event.packed));
  }
  return texts;
}

TEST(EventStream, SmallEventIsOneSegment) {
  EventSender sender;
  Offer(sender, "abc");
  const auto segment = sender.Next(kStart);
  ASSERT_TRUE(segment);
  EXPECT_TRUE(segment->base && segment->first && segment->last);
  EXPECT_EQ(ToText(segment->bytes), "abc");
}

TEST(EventStream, LargeEventIsPutTogetherAgain) {
  EventSender sender;
  EventReceiver receiver;
  const std::string text(1400, 'x');
  ASSERT_TRUE(Offer(sender, text));
  EXPECT_THAT(Exchange(sender, receiver, kStart), ElementsAre(text));
}

TEST(EventStream, TooLargeOrTooManyIsRefused) {
  EventSender sender;
  EXPECT_FALSE(Offer(sender, std::string(kSegmentBytes * kEventWindow + 1, 'x')));
  for (std::size_t i = 0; i < EventSender::kCapacity; ++i) EXPECT_TRUE(Offer(sender, "x"));
  EXPECT_FALSE(Offer(sender, "x"));
}

TEST(EventStream, NothingIsSentTwiceBeforeItIsOverdue) {
  EventSender sender;
  Offer(sender, "abc");
  sender.MarkSent(0, kStart, kStart);
  EXPECT_FALSE(sender.Ready(kStart + Duration(100'000)));
  EXPECT_TRUE(sender.Ready(kStart + Duration(600'000)));
}

TEST(EventStream, AcknowledgedIsForgotten) {
  EventSender sender;
  EventReceiver receiver;
  RoundTrip round_trip;
  Offer(sender, "abc");
  Exchange(sender, receiver, kStart);
  EXPECT_TRUE(receiver.ack_due());
  EXPECT_EQ(sender.OnAck(receiver.ack(), kStart + Duration(50'000), round_trip), 1U);
  EXPECT_TRUE(sender.events().empty());
  EXPECT_EQ(round_trip.smoothed(), Duration(50'000));
}

TEST(EventStream, BeforeTheBaseArrivesNothingIsAcknowledged) {
  EventSender sender;
  EventReceiver receiver;
  RoundTrip round_trip;
  for (const char* text : {"a", "b", "c"}) Offer(sender, text);
  for (int i = 0; i < 3; ++i) {
    const auto segment = sender.Next(kStart);
    sender.MarkSent(segment->number, kStart + Duration(i), kStart + Duration(i));
    if (i != 0) receiver.OnSegment(*segment, kStart);
  }
  // The receiver has not seen the base yet and cannot know where to begin.
  EXPECT_FALSE(receiver.ack_due());
  const auto base = sender.Next(kStart + kOverdue);
  ASSERT_EQ(base->number, 0);
}

TEST(EventStream, HoleIsFilledBeforeItsTime) {
  EventSender sender;
  EventReceiver receiver;
  RoundTrip round_trip;
  Offer(sender, "zero");
  Exchange(sender, receiver, kStart);
  sender.OnAck(receiver.ack(), kStart, round_trip);
  for (const char* text : {"a", "b"}) Offer(sender, text);
  sender.MarkSent(1, kStart, kStart);  // lost
  const auto second = sender.Next(kStart);
  sender.MarkSent(second->number, kStart + Duration(1), kStart + Duration(1));
  EXPECT_TRUE(receiver.OnSegment(*second, kStart).empty());
  sender.OnAck(receiver.ack(), kStart + Duration(2), round_trip);
  ASSERT_TRUE(sender.Next(kStart + Duration(3)));
  EXPECT_EQ(sender.Next(kStart + Duration(3))->number, 1);
  EXPECT_THAT(Exchange(sender, receiver, kStart + Duration(3)), ElementsAre("a", "b"));
}

TEST(EventStream, DuplicateIsAcknowledgedAgainAndNotDelivered) {
  EventSender sender;
  EventReceiver receiver;
  Offer(sender, "abc");
  const auto segment = sender.Next(kStart);
  EXPECT_EQ(receiver.OnSegment(*segment, kStart).size(), 1U);
  receiver.set_ack_due(false);
  EXPECT_TRUE(receiver.OnSegment(*segment, kStart).empty());
  EXPECT_TRUE(receiver.ack_due());
}

TEST(EventStream, StaleReceiverCatchesUpWithTheBase) {
  EventSender sender(200);
  EventReceiver receiver(190, true);  // remembers less than it acknowledged
  Offer(sender, "abc");
  EXPECT_THAT(Exchange(sender, receiver, kStart), ElementsAre("abc"));
}

TEST(EventStream, HalfOfTheNumbersAwayIsOld) {
  const EventSegment base{
      .number = 200, .base = true, .first = true, .last = true, .bits = 8, .bytes = Text("a")};
  EventReceiver stale(200 - 127, true), ahead(200 - 128, true);
  EXPECT_EQ(stale.OnSegment(base, kStart).size(), 1U);
  EXPECT_TRUE(ahead.OnSegment(base, kStart).empty());
  EXPECT_EQ(ahead.next(), 200 - 128);
}

TEST(EventStream, OldAcknowledgementIsIgnored) {
  EventSender sender(10);
  RoundTrip round_trip;
  Offer(sender, "abc");
  EXPECT_EQ(sender.OnAck({.next = 5, .prefix = 0, .held = 0}, kStart, round_trip), 0U);
  EXPECT_EQ(sender.OnAck({.next = 12, .prefix = 0, .held = 0}, kStart, round_trip), 0U);
  EXPECT_EQ(sender.events().size(), 1U);
}

TEST(EventStream, RestartedReceiverMakesTheSenderRepeatWhatItHeld) {
  EventSender sender;
  EventReceiver receiver;
  RoundTrip round_trip;
  Offer(sender, std::string(3 * kSegmentBytes, 'x'));
  for (int i = 0; i < 2; ++i) {
    const auto segment = sender.Next(kStart);
    sender.MarkSent(segment->number, kStart, kStart);
    receiver.OnSegment(*segment, kStart);
  }
  sender.OnAck(receiver.ack(), kStart, round_trip);
  EXPECT_EQ(sender.Next(kStart)->number, 2);
  EventReceiver restarted(receiver.next(), true);
  sender.OnAck(restarted.ack(), kStart, round_trip);
  EXPECT_EQ(sender.Next(kStart + kOverdue)->number, 0);
}

TEST(EventStream, AgeOfAnEventIsKept) {
  EventSender sender;
  EventReceiver receiver;
  Offer(sender, "abc", kStart);
  const Time sent = kStart + Duration(2'000'000);
  const auto events = receiver.OnSegment(*sender.Next(sent), sent);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].packed_at, kStart);
}

/// The whole protocol under loss and restarts of both ends, without the link around it.
TEST(EventStream, ExactlyOnceInOrderUnderLossAndRestarts) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng(seed);
    EventSender sender;
    EventReceiver receiver;
    RoundTrip round_trip;
    std::vector<std::string> sent, got;
    Time now = kStart;
    for (int step = 0; step < 2000; ++step) {
      now += Duration(50'000);
      if (sent.size() < 300 && rng.Chance(0.3)) {
        const std::string text = std::to_string(sent.size()) + std::string(rng.Below(200), '.');
        if (Offer(sender, text, now)) sent.push_back(text);
      }
      if (const auto segment = sender.Next(now)) {
        sender.MarkSent(segment->number, now, now);
        if (!rng.Chance(0.3))
          for (const auto& event : receiver.OnSegment(*segment, now)) got.push_back(ToText(event.packed));
      }
      if (receiver.ack_due() && !rng.Chance(0.3)) sender.OnAck(receiver.ack(), now, round_trip);
      if (rng.Chance(0.01)) receiver = EventReceiver(receiver.next(), receiver.known());
      if (rng.Chance(0.01)) {
        EventSender restarted(sender.next());
        for (const auto& event : sender.events()) restarted.Restore(event);
        sender = restarted;
      }
    }
    for (int i = 0; i < 3000 && !sender.events().empty(); ++i) {
      now += Duration(700'000);
      for (const std::string& text : Exchange(sender, receiver, now)) got.push_back(text);
      sender.OnAck(receiver.ack(), now, round_trip);
    }
    ASSERT_EQ(got, sent) << seed;
  }
}

TEST(RoundTrip, TakesAnEighthOfAnErrorAndAllowsFourDeviations) {
  RoundTrip dut;
  dut.Sample(Duration(200'000));
  EXPECT_EQ(dut.timeout(), Duration(200'000 + 4 * 100'000));
  dut.Sample(Duration(280'000));
  EXPECT_EQ(dut.smoothed(), Duration(210'000));
  EXPECT_EQ(dut.timeout(), Duration(210'000 + 4 * 95'000));
}

TEST(RoundTrip, TimeoutFollowsTheMeasurements) {
  RoundTrip dut;
  EXPECT_EQ(dut.timeout(), Duration(600'000));
  for (int i = 0; i < 50; ++i) dut.Sample(Duration(200'000));
  EXPECT_NEAR(Seconds(dut.timeout()), 0.2, 0.02);
  dut.Sample(Duration(1'000'000));
  EXPECT_GT(Seconds(dut.timeout()), 0.5);
}

}  // namespace
}  // namespace priamos::bus::radio
