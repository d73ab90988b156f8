#include "bus/radio/line/polling.hpp"

#include <gtest/gtest.h>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kMs{1000};
constexpr SharedChannel kChannel{
    .turnaround = 20 * kMs, .latency = kMs, .grace = 5 * kMs, .answer = 50 * kMs};
constexpr SharedFrames kFrames{.poll = 15 * kMs, .urgent = 25 * kMs};

TEST(PollCycle, TheStationWaitsForTheTurnaroundAfterAnAnswer) {
  PollCycle dut(kChannel, 4);
  dut.OnPollSent(dut.Next(), kStart);
  EXPECT_EQ(dut.polled(), 1);
  EXPECT_FALSE(dut.MayTalk(kStart + 60 * kMs));
  dut.OnAnswer(kStart + 40 * kMs);
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
    if (address != 2 || present) dut.OnAnswer(now + 30 * kMs);
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
  EXPECT_LE(absent, 20);  // one in four cycles of three or four
  PollsOfRobotTwo(dut, now, 40, true);
  EXPECT_EQ(PollsOfRobotTwo(dut, now, 40, true), 10);
}

TEST(PollBounds, GrowWithTheRobots) {
  const PollBounds four = ComputePollBounds(kChannel, kFrames, 4, kMs);
  EXPECT_EQ(four.slot, 114 * kMs);
  EXPECT_EQ(four.cycle, 684 * kMs);
  EXPECT_EQ(four.urgent_one, 141 * kMs);
  EXPECT_EQ(four.urgent_all, 219 * kMs);
}

}  // namespace
}  // namespace priamos::bus::radio
