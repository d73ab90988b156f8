#include "bus/radio/bundle_builder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const ChannelTable& Table() {
  static const ChannelTable table(TestChannels(), false);
  return table;
}

StateEntry Slow() {
  return {kSlowUp, 800, std::vector<std::byte>(100, std::byte{1})};
}

TEST(BundleBuilder, WhatWasAddedIsRead) {
  BundleBuilder dut(Table(), 120, false);
  EXPECT_TRUE(dut.empty());
  EXPECT_TRUE(dut.Add(FloorEntry{5}));
  EXPECT_TRUE(dut.Add(StateEntry{kPoseUp, 80, Text("0123456789")}));
  dut.AddOver();
  const std::size_t frame_bytes = dut.FrameBytes();
  const auto bundle = dut.Finish();
  EXPECT_EQ(frame_bytes, bundle.size() + kFrameOverhead);
  const ParsedBundle parsed = ParseBundle(Table(), Direction::kUp, bundle);
  EXPECT_TRUE(parsed.whole);
  ASSERT_EQ(parsed.entries.size(), 3U);
  EXPECT_EQ(ToText(std::get<StateEntry>(parsed.entries[1]).packed), "0123456789");
}

TEST(BundleBuilder, ALimitKeepsOutWhatFollowsAndNotWhatIsThere) {
  const StateEntry pose{kPoseUp, 80, Text("0123456789")};  // 83 bits
  BundleBuilder dut(Table(), 120, false);
  EXPECT_TRUE(dut.Add(pose));
  dut.LimitTo(10);  // it has 11 already: too late for a limit
  EXPECT_TRUE(dut.Add(pose));
  dut.LimitTo(31);
  EXPECT_FALSE(dut.Add(pose));
  dut.LimitTo(120);
  EXPECT_FALSE(dut.Add(pose)) << "a limit is not lifted";
}

TEST(BundleBuilder, ALongMessageGoesAlone) {
  BundleBuilder dut(Table(), 60, false);
  EXPECT_TRUE(dut.Add(Slow()));
  EXPECT_FALSE(dut.Add(StateEntry{kPoseUp, 80, Text("0123456789")}));
}

TEST(BundleBuilder, ControlEntriesDoNotKeepALongMessageOut) {
  BundleBuilder dut(Table(), 60, false);
  EXPECT_TRUE(dut.Add(FloorEntry{5}));
  EXPECT_TRUE(dut.Add(Slow()));
}

TEST(BestBundle, IsSmallerTheMoreIsLost) {
  EXPECT_EQ(BestBundleBytes(120, 0), 120U);
  EXPECT_EQ(BestBundleBytes(120, 0.001), 120U);
  EXPECT_EQ(BestBundleBytes(240, 0.99), 60U);
  EXPECT_LT(BestBundleBytes(240, 0.1), BestBundleBytes(240, 0.02));
}

RC_GTEST_PROP(BestBundle, IsWithinItsBounds, ()) {
  const auto max = static_cast<std::size_t>(*rc::gen::inRange(60, 241));
  const double loss = *rc::gen::inRange(0, 1001) / 1000.0;
  RC_ASSERT(BestBundleBytes(max, loss) >= 60U);
  RC_ASSERT(BestBundleBytes(max, loss) <= max);
  RC_ASSERT(BestBundleBytes(max, loss) >= BestBundleBytes(max, std::min(1.0, loss + 0.01)));
}

RC_GTEST_PROP(BundleBuilder, HoldsWhatFitsAndRoomForOver, (std::uint64_t seed)) {
  Rng rng(seed);
  const std::size_t target = 60 + rng.Below(kMaxBundleBytes - 60);
  BundleBuilder dut(Table(), target, true);
  std::size_t added = 0;
  bool has_message = false;
  for (std::size_t i = 0; i < 40; ++i) {
    const EventSegment segment{.last = true, .bits = 8 * (i % 26), .bytes = std::vector<std::byte>(i % 26)};
    const bool message = rng.Chance(0.7);
    if (!dut.Add(message ? BundleEntry(EventEntry{kEventUp, segment}) : FloorEntry{7})) continue;
    ++added;
    RC_ASSERT(dut.FrameBytes() <= kFrameOverhead + (has_message ? target : kMaxBundleBytes));
    has_message = has_message || message;
  }
  const std::size_t before = dut.FrameBytes();
  dut.AddOver();
  RC_ASSERT(dut.FrameBytes() <= std::max(before, kFrameOverhead + target));
  const ParsedBundle parsed = ParseBundle(Table(), Direction::kUp, dut.Finish());
  RC_ASSERT(parsed.whole);
  RC_ASSERT(parsed.entries.size() == added + 1);
}

}  // namespace
}  // namespace priamos::bus::radio
