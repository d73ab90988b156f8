#include "bus/radio/frame_length.hpp"

#include <gtest/gtest.h>

#include "bus/radio/channels/entry_sizes.hpp"
#include "test/bus/radio/measurement/numbered_message.hpp"

namespace priamos::bus::radio {
namespace {

FrameLength LengthOf(const LinkOptions& options, double commands_hz, Direction direction = Direction::kDown) {
  std::vector<LinkChannel> channels = TestChannels();
  channels[kDriveDown].rate_hz = commands_hz;
  return FrameLengthOf(ChannelTable(channels, false), options, direction);
}

TEST(FrameLength, AFrameLastsNoLongerThanTheTimeBetweenTwoCommands) {
  // 8 bytes beside the bundle: COBS, counter, echo, code, delimiter.
  EXPECT_EQ(LengthOf({}, 20).bundle_bytes, 48U - 8);
  EXPECT_TRUE(LengthOf({}, 20).strict);
  EXPECT_EQ(LengthOf({}, 12).bundle_bytes, 80U - 8);
}

TEST(FrameLength, WithoutCommandsOrWithRareOnesIsTheUsualOne) {
  for (const FrameLength& dut : {LengthOf({}, 20, Direction::kUp), LengthOf({}, 5), LengthOf({}, 0)}) {
    EXPECT_EQ(dut.bundle_bytes, 120U);
    EXPECT_FALSE(dut.strict);
  }
}

TEST(FrameLength, IsTheUsualOneWhereAMessageWouldNotFitOrFramesDoNotDecide) {
  EXPECT_EQ(LengthOf({.bytes_per_s = 240}, 20).bundle_bytes, 120U);  // 12 bytes, and a segment has 32
  EXPECT_EQ(LengthOf({.half_duplex = {.turn = Duration(300'000)}}, 20).bundle_bytes, 120U);
  EXPECT_EQ(LengthOf({.datagrams = true, .packet_overhead = Duration(5'000)}, 20).bundle_bytes, 120U);
  EXPECT_TRUE(LengthOf({.max_bundle_bytes = 23, .robots = 2}, 20).strict);
  EXPECT_EQ(LengthOf({.max_bundle_bytes = 23, .robots = 2}, 20).bundle_bytes, 23U);
}

/// Every end, every mixture of events and acknowledgements: no frame is longer than the time between
/// commands.
TEST(FrameLength, HoldsForEveryFrameButStops) {
  LinkPair dut;
  dut.Run(1);
  dut.wire_down.clear();
  int up = 0, down = 0;
  std::uint32_t number = 0;
  dut.each_step = [&] {
    KeepEventsWaiting(dut, dut.onboard, kEventUp, 60, up);
    KeepEventsWaiting(dut, dut.offboard, kEventDown, 200, down);
    if (ToUtime(dut.now) % 50'000 == 0)
      dut.offboard.link->Offer(kDriveDown, NumberedMessage(number++, 5), dut.now);
  };
  dut.Run(20);
  std::size_t longest = 0;
  for (const auto& frame : FramesOf(dut.wire_down)) longest = std::max(longest, frame.size());
  EXPECT_LE(longest, 48U);
  EXPECT_GE(longest, 45U);
  const std::uint64_t obeyed = dut.onboard.link->delivered(kDriveDown).delivered;
  EXPECT_GE(obeyed + 2, number) << "the last ones are on their way";
  EXPECT_GE(dut.onboard.TextsOf(kEventDown).size(), 20U);
}

/// The longest entry of a message is that of a first segment, or of a message of one segment.
TEST(EntrySizes, AMessageOfOneSegmentCanHaveALongerEntryThanALongOne) {
  const ChannelTable table(TestChannels(), false);
  const EntrySizes dut = SizesOf(table, kEventDown);
  EXPECT_GT(dut.entries, 1);
  EXPECT_EQ(dut.single_bits, dut.entry_bits + 5);
  EXPECT_EQ(static_cast<double>(LargestEntryBits(table, Direction::kDown)), dut.single_bits);
  EXPECT_EQ(SizesOf(table, kDriveDown).single_bits, 0);
}

}  // namespace
}  // namespace priamos::bus::radio
