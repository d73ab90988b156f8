#include "bus/radio/line/polling.hpp"

#include <gtest/gtest.h>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kMs{1000};
constexpr SharedChannel kChannel{.turnaround = 20 * kMs, .latency = kMs, .grace = 5 * kMs, .turn = 50 * kMs};
constexpr StationFrames kFrames{.poll = 15 * kMs, .urgent = 25 * kMs};

TEST(PolledTurn, ARobotIsSilentWithoutAPoll) {
  const PolledTurn dut(kChannel);
  EXPECT_FALSE(dut.MaySend(kStart, kMs));
}

TEST(PolledTurn, BeginsAfterTheTurnaroundWithinTheGrace) {
  PolledTurn dut(kChannel);
  dut.OnPoll(kStart);
  EXPECT_FALSE(dut.MaySend(kStart + 19 * kMs, kMs));
  EXPECT_TRUE(dut.MaySend(kStart + 20 * kMs, kMs));
  EXPECT_TRUE(dut.MaySend(kStart + 25 * kMs, kMs));
  EXPECT_FALSE(dut.MaySend(kStart + 26 * kMs, kMs));
}

TEST(PolledTurn, NoFrameReachesBeyondTheTurnAndNoneFollowsAnOver) {
  PolledTurn dut(kChannel);
  dut.OnPoll(kStart);
  EXPECT_FALSE(dut.MaySend(kStart + 20 * kMs, 51 * kMs));
  dut.OnSent(kStart + 20 * kMs, false);
  EXPECT_TRUE(dut.MaySend(kStart + 40 * kMs, 30 * kMs));
  EXPECT_FALSE(dut.MaySend(kStart + 41 * kMs, 30 * kMs));
  dut.OnSent(kStart + 40 * kMs, true);
  EXPECT_FALSE(dut.MaySend(kStart + 42 * kMs, kMs));
}

TEST(PollCycle, AForeignFrameDoesNotEndTheTurn) {
  PollCycle dut(kChannel, 4);
  dut.OnPollSent(dut.Next(), kStart);
  dut.OnFrame(2, kStart + 30 * kMs, true);
  EXPECT_FALSE(dut.MayTalk(kStart + 60 * kMs));
  dut.OnFrame(1, kStart + 40 * kMs, true);
  EXPECT_FALSE(dut.MayTalk(kStart + 59 * kMs));
  EXPECT_TRUE(dut.MayTalk(kStart + 60 * kMs));
}

TEST(PollCycle, ALostOverCostsNoMoreThanTheTurn) {
  PollCycle dut(kChannel, 1);
  dut.OnPollSent(dut.Next(), kStart);
  dut.OnBytes();
  dut.Step(kStart + 77 * kMs);
  EXPECT_FALSE(dut.MayTalk(kStart + 97 * kMs));
  dut.Step(kStart + 78 * kMs);
  EXPECT_TRUE(dut.MayTalk(kStart + 97 * kMs));
}

/// Polls `polls` times; robot 2 answers only if `present`.
int PollsOfRobotTwo(PollCycle& dut, Time& now, int polls, bool present) {
  int count = 0;
  for (int i = 0; i < polls; ++i) {
    const std::uint8_t address = dut.Next();
    count += address == 2 ? 1 : 0;
    dut.OnPollSent(address, now);
    if (address != 2 || present) dut.OnFrame(address, now + 30 * kMs, true);
    for (; !dut.MayTalk(now); now += kMs) dut.Step(now);
  }
  return count;
}

TEST(PollCycle, AnAbsentRobotIsPolledLessOftenAndComesBack) {
  PollCycle dut(kChannel, 4);
  Time now = kStart;
  PollsOfRobotTwo(dut, now, 200, false);
  const int absent = PollsOfRobotTwo(dut, now, 250, false);
  EXPECT_GE(absent, 9);
  EXPECT_LE(absent, 11);  // one in eight cycles of three or four
  PollsOfRobotTwo(dut, now, 40, true);
  EXPECT_EQ(PollsOfRobotTwo(dut, now, 40, true), 10);
}

TEST(PollBounds, AreNeverExceededAndNobodyTalksAtOnce) {
  const PollBounds bounds = ComputePollBounds(kChannel, kFrames, 4);
  PollCycle dut(kChannel, 4);
  Time now = kStart, poll_began = kStart;
  for (int i = 0; i < 400; ++i) {
    const std::uint8_t address = dut.Next();
    PolledTurn robot(kChannel);
    const Time poll_end = poll_began + kFrames.poll;
    dut.OnPollSent(address, poll_end);
    robot.OnPoll(poll_end + kChannel.latency);
    // Lost polls, late beginnings and lost overs in all combinations.
    const bool lost = i % 7 == 0, over_lost = i % 5 == 0;
    const Time begin = poll_end + kChannel.latency + kChannel.turnaround + (i % 6) * kMs;
    ASSERT_TRUE(robot.MaySend(begin, kChannel.turn));
    const Time end = begin + kChannel.turn + kChannel.latency;
    for (now = poll_end; !dut.MayTalk(now); now += kMs / 4) {
      if (!lost && now >= begin + kChannel.latency) dut.OnBytes();
      if (!lost && !over_lost && now == end) dut.OnFrame(address, now, true);
      dut.Step(now);
    }
    if (!lost) {
      ASSERT_GE(now, end + kChannel.turnaround);
    }
    ASSERT_LE(now + kFrames.urgent + kChannel.latency - poll_began, bounds.urgent_one);
    poll_began = now;
  }
}

TEST(PollBounds, GrowWithTheRobots) {
  const PollBounds four = ComputePollBounds(kChannel, kFrames, 4);
  EXPECT_EQ(four.cycle, 448 * kMs);
  EXPECT_EQ(four.urgent_one, 138 * kMs);
  EXPECT_EQ(four.urgent_all, 213 * kMs);
}

}  // namespace
}  // namespace priamos::bus::radio
