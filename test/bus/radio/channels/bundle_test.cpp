#include "bus/radio/channels/bundle.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

struct BundleTest : testing::Test {
  ChannelTable table{TestChannels(), false};
  std::vector<std::byte> Write(const std::vector<BundleEntry>& entries) const {
    BundleWriter out(table);
    for (const BundleEntry& entry : entries) out.Write(entry);
    return out.bytes();
  }
  ParsedBundle Parse(const std::vector<BundleEntry>& entries, Direction incoming = Direction::kUp) const {
    return ParseBundle(table, incoming, Write(entries));
  }
};

TEST_F(BundleTest, EverythingComesBack) {
  const EventSegment segment{.number = 200,
                             .base = true,
                             .first = true,
                             .last = false,
                             .age = Duration(1'500'000),
                             .bits = 8 * kSegmentBytes,
                             .bytes = Text(std::string(kSegmentBytes, 'e'))};
  const auto parsed =
      Parse({StateEntry{kPoseUp, 80, Text("0123456789")}, EventEntry{kEventUp, segment},
             EventAckEntry{kEventDown, {.next = 7, .prefix = 33, .held = 0x8001}},
             FrameAckEntry{.counter = 0xABC, .earlier = 0b1001, .hold = Duration(12'000), .loss = 0.4},
             FloorEntry{0x123456789A}, ListenEntry{0x2A}});
  ASSERT_TRUE(parsed.whole);
  ASSERT_EQ(parsed.entries.size(), 6U);
  EXPECT_EQ(ToText(std::get<StateEntry>(parsed.entries[0]).packed), "0123456789");
  const auto& event = std::get<EventEntry>(parsed.entries[1]);
  EXPECT_EQ(event.segment.number, 200);
  EXPECT_TRUE(event.segment.base && event.segment.first && !event.segment.last);
  EXPECT_EQ(event.segment.age, Duration(1'500'000));
  EXPECT_EQ(event.segment.bytes, segment.bytes);
  EXPECT_EQ(std::get<EventAckEntry>(parsed.entries[2]).ack.held, 0x8001U);
  EXPECT_EQ(std::get<EventAckEntry>(parsed.entries[2]).ack.prefix, 33);
  const auto& ack = std::get<FrameAckEntry>(parsed.entries[3]);
  EXPECT_EQ(ack.counter, 0xABC);
  EXPECT_EQ(ack.earlier, 0b1001);
  EXPECT_EQ(ack.hold, Duration(12'000));
  EXPECT_NEAR(ack.loss, 0.4, 0.001);
  EXPECT_EQ(std::get<FloorEntry>(parsed.entries[4]).counter, 0x123456789AU);
  EXPECT_EQ(std::get<ListenEntry>(parsed.entries[5]).channels, 0x2AU);
}

EventEntry WholeEvent(std::size_t channel, std::uint8_t number, const std::string& text) {
  EventEntry entry{channel, {}};
  entry.segment.number = number;
  entry.segment.first = entry.segment.last = true;
  entry.segment.bits = 8 * text.size();
  entry.segment.bytes = Text(text);
  return entry;
}

TEST_F(BundleTest, SegmentsThatFollowEachOtherAreARun) {
  const std::vector<BundleEntry> run{WholeEvent(kEventUp, 255, "a"), WholeEvent(kEventUp, 0, "bc"),
                                     WholeEvent(kEventUp, 1, ""), FloorEntry{5},
                                     WholeEvent(kEventUp, 2, "d")};
  const auto parsed = Parse(run);
  ASSERT_TRUE(parsed.whole);
  ASSERT_EQ(parsed.entries.size(), 5U);
  for (const std::size_t i : {0U, 1U, 2U, 4U}) {
    EXPECT_EQ(std::get<EventEntry>(parsed.entries[i]).segment.number,
              std::get<EventEntry>(run[i]).segment.number);
    EXPECT_EQ(std::get<EventEntry>(parsed.entries[i]).segment.bytes,
              std::get<EventEntry>(run[i]).segment.bytes);
  }
  BundleWriter dut(table);
  dut.Write(run[0]);
  const std::size_t first = dut.bits();
  EXPECT_EQ(dut.BitsWith(run[1]) - first, 1 + 2 + 12 + 5 + 16U);
  dut.Write(run[1]);
  EXPECT_EQ(dut.bits() - first, 1 + 2 + 12 + 5 + 16U);
}

TEST_F(BundleTest, WhatDoesNotFollowBeginsAnew) {
  const std::size_t first = BundleWriter(table).BitsWith(WholeEvent(kEventUp, 7, "a"));
  EventEntry base = WholeEvent(kEventUp, 8, "a");
  base.segment.base = true;
  for (const EventEntry& next : {WholeEvent(kEventUp, 9, "a"), WholeEvent(kEventUp, 7, "a"), base}) {
    BundleWriter dut(table);
    dut.Write(WholeEvent(kEventUp, 7, "a"));
    EXPECT_EQ(dut.BitsWith(next), 2 * first + 1);
  }
}

TEST_F(BundleTest, UrgentSegmentsAreNoRun) {
  auto stop = [](std::uint8_t number) {
    EventEntry entry = WholeEvent(kStopDown, number, "!");
    entry.segment.bits = 8;
    return entry;
  };
  BundleWriter dut(table);
  dut.Write(stop(1));
  const std::size_t first = dut.bits();
  dut.Write(stop(2));
  EXPECT_EQ(dut.bits(), 2 * first);
  EXPECT_EQ(ParseBundle(table, Direction::kDown, dut.bytes()).entries.size(), 2U);
}

TEST_F(BundleTest, ARunThatTheBundleCutsOffIsDamaged) {
  auto bytes = Write({WholeEvent(kEventUp, 7, "abc"), WholeEvent(kEventUp, 8, "defgh")});
  bytes.pop_back();
  bytes.pop_back();
  const auto parsed = ParseBundle(table, Direction::kUp, bytes);
  EXPECT_FALSE(parsed.whole);
  EXPECT_EQ(parsed.entries.size(), 1U);
}

TEST_F(BundleTest, DifferencesComeBackBetweenOthers) {
  auto channels = TestChannels();
  channels[kPoseUp].delta = {16, 64};
  table = ChannelTable(channels, false);
  const auto old_pose = Text("0123456789"), new_pose = Text("0123456799");
  const BitWriter delta = EncodeDelta(channels[kPoseUp].delta, old_pose, new_pose);
  const auto parsed = Parse({StateEntry{kPoseUp, 80, old_pose},
                             StateEntry{kPoseUp, delta.bits(), delta.bytes(), 17}, FloorEntry{5}});
  ASSERT_TRUE(parsed.whole);
  ASSERT_EQ(parsed.entries.size(), 3U);
  EXPECT_FALSE(std::get<StateEntry>(parsed.entries[0]).baseline);
  EXPECT_EQ(std::get<StateEntry>(parsed.entries[1]).baseline, 17);
  EXPECT_EQ(std::get<StateEntry>(parsed.entries[1]).packed, delta.bytes());
  EXPECT_EQ(std::get<FloorEntry>(parsed.entries[2]).counter, 5U);
}

TEST_F(BundleTest, FixedSizesCostOnlyTheirBitsAndANumber) {
  EXPECT_EQ(BundleWriter(table).BitsWith(StateEntry{kPoseUp, 80, Text("0123456789")}), 83U);
  EXPECT_EQ(BundleWriter(table).BitsWith(CommandEntry{kDriveDown, {}, 40, Text("abcde")}), 49U);
}

TEST_F(BundleTest, OffsetOfACommandIsRoundedDown) {
  for (const int us : {-250'000, -249'999, -7'813, -7'812, -1, 0, 1, 7'812, 7'813, 100'000, 242'187}) {
    const auto parsed = Parse({CommandEntry{kDriveDown, Duration(us), 40, Text("abcde")}}, Direction::kDown);
    const Duration offset = std::get<CommandEntry>(parsed.entries.at(0)).offset;
    EXPECT_LE(offset, Duration(us));
    EXPECT_GT(offset, Duration(us - 250'000 / 32 - 1)) << us;
  }
}

TEST_F(BundleTest, AnOffsetBeyondTheRangeMakesACommandOlder) {
  const auto parsed = Parse({CommandEntry{kDriveDown, FromSeconds(3), 40, Text("abcde")}}, Direction::kDown);
  EXPECT_EQ(std::get<CommandEntry>(parsed.entries.at(0)).offset, Duration(242'188));  // 31/32 of 0.25 s
}

TEST_F(BundleTest, MessagesOfTheOwnDirectionAreRefused) {
  EXPECT_FALSE(Parse({StateEntry{kPoseUp, 80, Text("0123456789")}}, Direction::kDown).whole);
  EXPECT_FALSE(Parse({EventAckEntry{kEventUp, {}}}, Direction::kUp).whole);
  EXPECT_FALSE(Parse({EventAckEntry{kPoseUp, {}}}, Direction::kDown).whole);
}

TEST_F(BundleTest, CutShortIsNoticed) {
  const auto bytes = Write({StateEntry{kPoseUp, 80, Text("0123456789")}});
  for (std::size_t n = 1; n < bytes.size(); ++n)
    EXPECT_FALSE(ParseBundle(table, Direction::kUp, std::span(bytes).first(n)).whole) << n;
}

TEST_F(BundleTest, AnyBytesAreReadWithoutHarm) {
  Rng rng(1);
  for (int i = 0; i < 200000; ++i) {
    std::vector<std::byte> noise(rng.Below(60));
    for (std::byte& b : noise) b = static_cast<std::byte>(rng.Below(256));
    ParseBundle(table, i % 2 == 0 ? Direction::kUp : Direction::kDown, noise);
  }
}

TEST(DurationCode, ErrorsStaySmall) {
  for (double s = 0; s < 8000; s = s * 1.1 + 0.001) {
    EXPECT_NEAR(Seconds(DecodeDuration12(EncodeDuration12(FromSeconds(s)))), s, 0.0006 + s * 0.005);
  }
  EXPECT_EQ(DecodeDuration12(EncodeDuration12(Duration(-5))), Duration(0));
}

}  // namespace
}  // namespace priamos::bus::radio
