#include "bus/radio/channels/age_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kWithin{280'000};

Time After(double s) {
  return kStart + FromSeconds(s);
}

struct AgeBoundTest : testing::Test {
  AgeBoundTest() { channels[kPoseUp].fresh = kWithin; }
  std::vector<LinkChannel> channels = TestChannels();
  ChannelTable table() const { return {channels, false}; }
  SendQueue::Candidate pose{.channel = kPoseUp};
  SendQueue::Candidate slow{.channel = kSlowUp, .slot = 3};
  /// A pose of which the rate lets the next go at `since`, beside messages that take so long.
  AgeBound::Waiting Beside(Time since, double others_s) {
    pose.since = since;
    return {.state = pose,
            .state_takes = FromSeconds(0.03),
            .others_take = FromSeconds(others_s),
            .longest_takes = FromSeconds(0.135)};
  }
  AgeBound::Waiting BesideALongOne(Time since) {
    AgeBound::Waiting waiting = Beside(since, 0);
    waiting.alone = slow;
    waiting.alone_takes = FromSeconds(0.15);
    return waiting;
  }
};

TEST_F(AgeBoundTest, IsOffWithoutAChannelThatHasOne) {
  EXPECT_TRUE(AgeBound(table(), Direction::kUp).enabled());
  EXPECT_FALSE(AgeBound(table(), Direction::kDown).enabled());
}

TEST_F(AgeBoundTest, BeforeTheFirstAndWithoutOneTheQueueDecides) {
  AgeBound dut(table(), Direction::kUp);
  EXPECT_FALSE(dut.Choose(Beside(kStart, 0.135), kStart));
  dut.OnFrame(true, {}, kStart);
  EXPECT_FALSE(dut.Choose({.others_take = FromSeconds(0.135)}, After(0.2)));
}

TEST_F(AgeBoundTest, AFrameThatLeavesTimeGoesWithoutIt) {
  AgeBound dut(table(), Direction::kUp);
  dut.OnFrame(true, {}, kStart);
  EXPECT_FALSE(dut.Choose(Beside(After(0.125), 0.05), After(0.05)));
  const auto first = dut.Choose(Beside(After(0.125), 0.135), After(0.05));
  ASSERT_TRUE(first) << "before its rate lets it";
  EXPECT_EQ(first->message.channel, kPoseUp);
  EXPECT_EQ(first->end, kStart + kWithin - AgeBound::kMargin);
}

TEST_F(AgeBoundTest, ALongMessageWaitsForAShortFrameAndIsTheNext) {
  AgeBound dut(table(), Direction::kUp);
  dut.OnFrame(true, {}, kStart);
  const auto before = dut.Choose(BesideALongOne(After(0.125)), After(0.1));
  ASSERT_TRUE(before);
  EXPECT_EQ(before->message.channel, kPoseUp);
  EXPECT_EQ(before->end, After(0.1) + kWithin - FromSeconds(0.03) - FromSeconds(0.15) - AgeBound::kMargin);
  dut.OnFrame(true, before, After(0.1));
  ASSERT_TRUE(dut.promised());
  EXPECT_EQ(dut.promised()->slot, slow.slot);
  const auto then = dut.Choose(BesideALongOne(After(0.225)), before->end);
  ASSERT_TRUE(then);
  EXPECT_EQ(then->message.channel, kSlowUp);
  EXPECT_EQ(then->end, After(0.1) + kWithin - FromSeconds(0.03) - AgeBound::kMargin);
  dut.OnFrame(false, then, before->end);
  EXPECT_FALSE(dut.promised());
}

TEST_F(AgeBoundTest, ALongMessageThatLeavesTimeGoesAtOnce) {
  AgeBound dut(table(), Direction::kUp);
  dut.OnFrame(true, {}, kStart);
  const auto first = dut.Choose(BesideALongOne(After(0.125)), After(0.05));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->message.channel, kSlowUp);
}

TEST_F(AgeBoundTest, AFrameThatWasCutOffDoesNotCount) {
  AgeBound dut(table(), Direction::kUp);
  dut.OnFrame(true, {}, kStart);
  dut.OnFrame(true, {}, After(0.1));
  dut.Undo();
  EXPECT_EQ(dut.Choose(Beside(After(0.1), 0.135), After(0.1))->end, kStart + kWithin - AgeBound::kMargin);
}

/// Whatever waits, as long as the bound is one that the budget allows: 2 * 0.135 s, and 0.15 s between 0.03 s
/// twice. Each frame takes the line until its end, and is no shorter than what goes first in it.
TEST_F(AgeBoundTest, EveryFrameWithTheStateKeepsToIt) {
  Rng rng = Rng::Stream(1, "frames");
  AgeBound dut(table(), Direction::kUp);
  dut.OnFrame(true, {}, kStart);
  Time now = After(0.03), last = kStart, allowed = After(0.125);
  int alone = 0, early = 0;
  for (int i = 0; i < 20'000; ++i) {
    AgeBound::Waiting waiting = Beside(allowed, rng.Uniform(0.015, 0.135));
    if (rng.Chance(0.2) || dut.promised()) {
      waiting.alone = slow;
      waiting.alone_takes = FromSeconds(0.15);
    }
    const bool in_turn = allowed <= now;
    const auto first = dut.Choose(waiting, now);
    const bool with_state = first ? first->message.channel == kPoseUp : in_turn;
    const bool goes_alone = first && first->message.channel == kSlowUp;
    Time end = now + (goes_alone ? waiting.alone_takes : waiting.others_take);
    if (with_state) end = now + FromSeconds(rng.Uniform(0.03, 0.135));
    if (first && with_state) end = std::max(now + waiting.state_takes, std::min(end, first->end));
    if (with_state) {
      ASSERT_LE(end, last + kWithin - AgeBound::kMargin) << i;
      early += !in_turn;
      last = now;
      allowed = std::max(allowed, now) + FromSeconds(0.125);
    }
    alone += goes_alone;
    dut.OnFrame(with_state, first, now);
    now = end;
  }
  EXPECT_GT(alone, 1000);
  EXPECT_GT(early, 1000);
}

}  // namespace
}  // namespace priamos::bus::radio
