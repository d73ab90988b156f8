#include "bus/radio/message_receiver.hpp"

#include <gtest/gtest.h>

#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);

std::vector<LinkChannel> WithDeltas() {
  std::vector<LinkChannel> channels = TestChannels();
  channels[kPoseUp].delta = {40, 40};
  return channels;
}

struct MessageReceiverTest : testing::Test {
  static Arrival Of(std::uint64_t counter, double age_s = 0.05) {
    return {.counter = counter, .sent_at = kStart - FromSeconds(age_s), .began = kStart, .now = kStart};
  }
  /// A frame that echoes one that left here so long ago.
  static Arrival Echoing(std::uint64_t counter, double ago_s) {
    Arrival arrival = Of(counter);
    arrival.echoed = kStart - FromSeconds(ago_s);
    return arrival;
  }
  static Arrival Overtaken(std::uint64_t counter) {
    Arrival arrival = Of(counter);
    arrival.newest = false;
    return arrival;
  }
  static EventEntry Event(std::uint8_t number, const std::string& text) {
    return {kEventUp,
            {.number = number,
             .base = number == 0,
             .first = true,
             .last = true,
             .bits = 8 * text.size(),
             .bytes = Text(text)}};
  }
  /// A difference between two poses.
  static StateEntry Difference(const std::string& from, const std::string& to, std::uint8_t baseline) {
    BitWriter delta = EncodeDelta({40, 40}, Text(from), Text(to));
    const std::size_t bits = delta.bits();
    return {kPoseUp, bits, delta.Finish(), baseline};
  }

  const ChannelTable table{WithDeltas(), false};
  MessageReceiver dut{table};
  std::vector<Delivery> out;
};

TEST_F(MessageReceiverTest, AStateIsAsOldAsItsFrame) {
  dut.OnState({kSlowUp, 800, Text("slow")}, Of(1), out);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].packed_at, kStart - FromSeconds(0.05));
  EXPECT_FALSE(out[0].valid_until);
  EXPECT_EQ(dut.counters(kSlowUp).bits, 800U);
}

TEST_F(MessageReceiverTest, WhatWasOvertakenIsLate) {
  dut.OnState({kSlowUp, 800, Text("slow")}, Overtaken(1), out);
  Arrival overtaken = Overtaken(1);
  overtaken.echoed = kStart;
  dut.OnCommand({kDriveDown, {}, 40, Text("abcde")}, overtaken, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(dut.counters(kSlowUp).late + dut.counters(kDriveDown).late, 2U);
}

TEST_F(MessageReceiverTest, ADifferenceIsCompletedFromTheFrameItNames) {
  dut.OnState({kPoseUp, 80, Text("aaaaabbbbb")}, Of(100), out);
  dut.OnState({kPoseUp, 80, Text("aaaaaccccc")}, Of(101), out);
  dut.OnState(Difference("aaaaabbbbb", "aaaaaddddd", 100 & 63), Of(102), out);
  ASSERT_EQ(out.size(), 3U);
  EXPECT_EQ(ToText(out[2].packed), "aaaaaddddd");
  EXPECT_FALSE(dut.Due());
}

TEST_F(MessageReceiverTest, WithoutTheBaselineItAsksToForgetAndAsksAgainAfterACut) {
  dut.OnState(Difference("aaaaabbbbb", "aaaaaddddd", 100 & 63), Of(102), out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(dut.counters(kPoseUp).late, 1U);
  EXPECT_TRUE(dut.Due());
  EXPECT_FALSE(dut.AckDue());
  BundleBuilder bundle(table, 120, false);
  const auto loaded = dut.Load(bundle);
  EXPECT_TRUE(loaded.forget);
  EXPECT_FALSE(dut.Due());
  dut.Return(loaded);
  EXPECT_TRUE(dut.Due());
}

TEST_F(MessageReceiverTest, NoDifferenceReachesAcrossEpochs) {
  dut.OnState({kPoseUp, 80, Text("aaaaabbbbb")}, Of(100), out);
  dut.OnEpochChanged();
  dut.OnState(Difference("aaaaabbbbb", "aaaaaddddd", 100 & 63), Of(102), out);
  EXPECT_EQ(out.size(), 1U);
}

TEST_F(MessageReceiverTest, ACommandCountsFromTheFrameThatItEchoes) {
  dut.OnCommand({kDriveDown, FromSeconds(0.04), 40, Text("abcde")}, Echoing(1, 0.1), out);
  dut.OnCommand({kDriveDown, FromSeconds(-0.04), 40, Text("abcde")}, Echoing(2, 0.1), out);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out[0].packed_at, kStart - FromSeconds(0.06));
  EXPECT_EQ(*out[0].valid_until, kStart + FromSeconds(0.19));
  EXPECT_EQ(out[1].packed_at, kStart - FromSeconds(0.14));
  EXPECT_EQ(*out[1].valid_until, kStart + FromSeconds(0.11));
}

TEST_F(MessageReceiverTest, ACommandThatIsTooOldOrUnprovenIsLate) {
  dut.OnCommand({kDriveDown, FromSeconds(-0.1), 40, Text("abcde")}, Echoing(1, 0.15), out);
  EXPECT_EQ(out.size(), 1U);  // just in time
  dut.OnCommand({kDriveDown, FromSeconds(-0.1), 40, Text("abcde")}, Echoing(2, 0.151), out);
  dut.OnCommand({kDriveDown, FromSeconds(0.1), 40, Text("abcde")}, Of(3), out);
  EXPECT_EQ(out.size(), 1U);
  EXPECT_EQ(dut.counters(kDriveDown).late, 2U);
}

TEST_F(MessageReceiverTest, EventsAreRememberedAcknowledgedAndDeliveredOnce) {
  EXPECT_TRUE(dut.OnEvent(Event(0, "one"), Of(1), out));
  EXPECT_FALSE(dut.OnEvent(Event(0, "one"), Of(2), out));
  EXPECT_TRUE(dut.OnEvent(Event(1, "two"), Overtaken(1), out));  // order is that of the numbers
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(ToText(out[1].packed), "two");
  EXPECT_TRUE(dut.AckDue());
  BundleBuilder bundle(table, 120, false);
  const auto loaded = dut.Load(bundle);
  EXPECT_EQ(loaded.acks, std::vector<std::size_t>{kEventUp});
  EXPECT_FALSE(dut.AckDue());
  dut.Return(loaded);
  EXPECT_TRUE(dut.AckDue());
}

TEST_F(MessageReceiverTest, ANewNumberingBeginsAnywhere) {
  dut.OnEvent(Event(0, "one"), Of(1), out);
  dut.ForgetEvents();
  EventEntry anew = Event(200, "anew");
  anew.segment.base = true;
  EXPECT_TRUE(dut.OnEvent(anew, Of(2), out));
  EXPECT_EQ(ToText(out.back().packed), "anew");
}

}  // namespace
}  // namespace priamos::bus::radio
