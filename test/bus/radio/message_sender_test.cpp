#include "bus/radio/message_sender.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
Time After(double s) {
  return kStart + FromSeconds(s);
}

std::vector<LinkChannel> WithDeltas() {
  std::vector<LinkChannel> channels = TestChannels();
  channels[kPoseUp].delta = {40, 40};
  for (LinkChannel& c : channels) c.rate_hz = 0;
  return channels;
}

struct Fixture {
  explicit Fixture(Direction outgoing = Direction::kUp)
      : direction(outgoing), dut(table, outgoing, Duration(1'000'000), [](std::size_t, auto encoded, Time) {
          const bool refused = !encoded.empty() && encoded[0] == std::byte{'?'};
          return refused ? std::nullopt
                         : std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
        }) {}

  MessageSender::Loaded Load(Time now, std::uint64_t counter, bool urgent_only = false) {
    BundleBuilder bundle(table, 120, false);
    auto loaded =
        dut.Load(bundle, {.now = now,
                          .counter = counter,
                          .urgent_only = urgent_only,
                          .leaves_at = [now](std::size_t bytes) { return now + Duration(1000 * bytes); },
                          .echoed_at = echoed_at});
    entries = ParseBundle(table, direction, bundle.Finish()).entries;
    return loaded;
  }
  /// Offers a pose and sends it whole in the frame with this counter.
  void Send(const std::string& pose, std::uint64_t counter) {
    dut.Offer(kPoseUp, Text(pose), kStart, "");
    dut.OnSent(Load(kStart, counter), counter);
  }
  const StateEntry& State() const { return std::get<StateEntry>(entries.at(0)); }

  Direction direction;
  const ChannelTable table{WithDeltas(), false};
  MessageSender dut;
  std::vector<BundleEntry> entries;
  std::optional<Time> echoed_at;
};

TEST(MessageSender, TakesWhatIsOutgoingAndCanBePacked) {
  Fixture f;
  EXPECT_EQ(f.dut.Offer(kDriveDown, Text("abcde"), kStart, ""), OfferResult::kNotOutgoing);
  EXPECT_EQ(f.dut.Offer(99, Text("abcde"), kStart, ""), OfferResult::kNotOutgoing);
  EXPECT_EQ(f.dut.Offer(kEventUp, Text("?"), kStart, ""), OfferResult::kRefused);
  EXPECT_EQ(f.dut.queue().counters(kEventUp).refused, 1U);
  EXPECT_EQ(f.dut.Offer(kEventUp, Text("event"), kStart, ""), OfferResult::kAccepted);
}

TEST(MessageSender, AStateThatCannotBePackedIsRefusedWhenItsTurnComes) {
  Fixture f;
  EXPECT_EQ(f.dut.Offer(kPoseUp, Text("?"), kStart, ""), OfferResult::kAccepted);
  f.Load(kStart, 1);
  EXPECT_TRUE(f.entries.empty());
  EXPECT_EQ(f.dut.queue().counters(kPoseUp).refused, 1U);
  EXPECT_TRUE(f.dut.queue().Ready(kStart).empty());
}

TEST(MessageSender, FillsTheBundleInTheOrderOfTheQueue) {
  Fixture f;
  f.dut.Offer(kEventUp, Text(std::string(20, 'e')), kStart, "");
  f.dut.Offer(kPoseUp, Text("0123456789"), kStart, "");
  f.dut.Offer(kSlowUp, Text(std::string(100, 's')), kStart, "");
  const auto loaded = f.Load(kStart, 1);
  ASSERT_EQ(f.entries.size(), 2U);  // the slow one does not fit any more
  EXPECT_TRUE(std::holds_alternative<StateEntry>(f.entries[0]));
  EXPECT_TRUE(std::holds_alternative<EventEntry>(f.entries[1]));
  EXPECT_EQ(loaded.messages.size() + loaded.segments.size(), 2U);
  EXPECT_EQ(f.dut.queue().Ready(kStart).size(), 1U);
}

TEST(MessageSender, UrgentOnlyLeavesTheRest) {
  Fixture f(Direction::kDown);
  f.dut.Offer(kEventDown, Text("event"), kStart, "");
  f.dut.Offer(kStopDown, Text("!"), kStart, "");
  EXPECT_TRUE(f.Load(kStart, 1, true).messages.empty());
  ASSERT_EQ(f.entries.size(), 1U);
  EXPECT_EQ(std::get<EventEntry>(f.entries[0]).channel, kStopDown);
}

TEST(MessageSender, AnUrgentEventDoesNotTravelWithRepetitionsOfAnother) {
  Fixture f(Direction::kDown);
  f.dut.Offer(kStopDown, Text("1"), kStart, "");
  f.Load(kStart, 1, true);
  f.dut.Offer(kStopDown, Text("2"), After(1), "");  // the first one is overdue now
  f.Load(After(1), 2, true);
  ASSERT_EQ(f.entries.size(), 1U);
  EXPECT_EQ(ToText(std::get<EventEntry>(f.entries[0]).segment.bytes), "2");
}

TEST(MessageSender, ACutFrameSentNothing) {
  Fixture f;
  f.dut.Offer(kEventUp, Text("event"), kStart, "");
  f.dut.Offer(kPoseUp, Text("0123456789"), kStart, "");
  f.dut.Return(f.Load(kStart, 1));
  EXPECT_EQ(f.dut.queue().counters(kPoseUp).sent, 0U);
  f.Load(kStart, 2);
  EXPECT_EQ(f.entries.size(), 2U);
  EXPECT_EQ(f.dut.resent(), 0U);
}

TEST(MessageSender, DifferencesReferOnlyToWhatWasAcknowledged) {
  Fixture f;
  f.Send("aaaaabbbbb", 10);
  f.Send("aaaaaccccc", 11);
  EXPECT_FALSE(f.State().baseline);
  f.dut.OnFrameAcknowledged(10);
  f.Send("aaaaaddddd", 12);
  EXPECT_EQ(f.State().baseline, 10);
  f.dut.ForgetBaselines();
  f.Send("aaaaaeeeee", 13);
  EXPECT_FALSE(f.State().baseline);
}

TEST(MessageSender, ALongerDifferenceIsNotSent) {
  Fixture f;
  f.Send("aaaaabbbbb", 10);
  f.dut.OnFrameAcknowledged(10);
  f.Send("zzzzzyyyyy", 11);
  EXPECT_FALSE(f.State().baseline);
}

TEST(MessageSender, ACommandSaysHowLongBeforeOrAfterTheEchoedFrameItWasOffered) {
  for (const double heard_s : {-0.2, -0.1, 0.0, 0.05, 0.1}) {
    Fixture f(Direction::kDown);
    f.echoed_at = After(heard_s);
    f.dut.Offer(kDriveDown, Text("abcde"), kStart, "");
    f.Load(After(0.1), 1);
    const double offset_s = Seconds(std::get<CommandEntry>(f.entries.at(0)).offset);
    EXPECT_LE(offset_s, -heard_s);
    EXPECT_GT(offset_s, -heard_s - 0.25 / 32 - 1e-6);
  }
}

TEST(MessageSender, ACommandWaitsForAnEchoAndOneTooOldStays) {
  Fixture f(Direction::kDown);
  f.dut.Offer(kDriveDown, Text("abcde"), kStart, "");
  f.Load(kStart, 1);
  EXPECT_TRUE(f.entries.empty());
  f.echoed_at = After(0.3);
  f.Load(After(0.3), 2);
  EXPECT_TRUE(f.entries.empty()) << "no offset could say how old it is";
  f.dut.Offer(kDriveDown, Text("fresh"), After(0.3), "");
  f.Load(After(0.3), 3);
  EXPECT_EQ(f.entries.size(), 1U);
}

TEST(MessageSender, ACommandIsPackedWithTheTimeOfItsOffer) {
  const ChannelTable table(TestChannels(), false);
  std::vector<Time> packed_with;
  MessageSender dut(table, Direction::kDown, FromSeconds(1), [&](std::size_t, auto encoded, Time now) {
    packed_with.push_back(now);
    return std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
  });
  dut.Offer(kDriveDown, Text("abcde"), kStart, "");
  BundleBuilder bundle(table, 120, false);
  dut.Load(bundle, {.now = After(0.1), .counter = 1, .leaves_at = {}, .echoed_at = After(0.05)});
  EXPECT_EQ(packed_with, std::vector{kStart});
}

TEST(MessageSender, EventsAreSentAgainAfterTheirTimeoutOrWhenTheLinkIsBack) {
  Fixture f;
  f.dut.Offer(kEventUp, Text("event"), kStart, "");
  f.Load(kStart, 1);
  EXPECT_TRUE(f.Load(After(0.1), 2).segments.empty());
  f.dut.OnLinkBack();
  EXPECT_EQ(f.Load(After(0.1), 3).segments.size(), 1U);
  EXPECT_EQ(f.Load(After(5), 4).segments.size(), 1U);
  EXPECT_EQ(f.dut.resent(), 2U);
  EXPECT_EQ(f.dut.OnEventAck({kEventUp, {.next = 1}}, After(5.1)), 1U);
  EXPECT_EQ(f.dut.queue().counters(kEventUp).sent, 1U);
  EXPECT_TRUE(f.Load(After(50), 5).segments.empty());
}

RC_GTEST_PROP(MessageSender, WhatIsCutIsSentByTheNextFrameAsItWas, (std::uint64_t seed)) {
  Rng rng(seed);
  Fixture f;
  for (int i = 0; i < 5; ++i)
    f.dut.Offer(kEventUp, Text(std::string(1 + rng.Below(90), static_cast<char>('a' + i))), kStart, "");
  if (rng.Chance(0.5)) f.dut.Offer(kPoseUp, Text("0123456789"), kStart, "");
  MessageSender copy = f.dut;
  f.dut.Return(f.Load(kStart, 1));
  f.Load(kStart, 2);
  BundleBuilder bundle(f.table, 120, false);
  copy.Load(bundle, {.now = kStart, .counter = 2, .leaves_at = [](std::size_t) { return kStart; }});
  BundleBuilder again(f.table, 120, false);
  for (const BundleEntry& entry : f.entries) again.Add(entry);
  RC_ASSERT(bundle.Finish() == again.Finish());
}

}  // namespace
}  // namespace priamos::bus::radio
