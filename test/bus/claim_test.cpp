#include "bus/claim.hpp"

#include <gtest/gtest.h>

#include "bus/claim_messages.hpp"

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using State = Claim::State;

const Time kStart = FromUtime(1'000'000'000);

Claimant Of(const std::string& role, std::int32_t instance, const std::string& robot = "priamos") {
  return {robot, role, instance, "hall9", 100 + instance};
}

ClaimWord Holds(std::int32_t instance, Duration age) {
  return {Of("robot", instance), true, age};
}

ClaimWord Asks(std::int32_t instance, Duration age) {
  return {Of("robot", instance), false, age};
}

/// Runs `dut` from `from` to `to` in steps of 1 ms and returns what it said.
std::vector<ClaimWord> Elapse(Claim& dut, Time from, Time to) {
  std::vector<ClaimWord> said;
  for (Time now = from; now <= to; now += milliseconds(1)) {
    dut.Touch(now);
    if (const auto word = dut.Step(now)) said.push_back(*word);
  }
  return said;
}

Claim Held(std::int32_t instance, Time at = kStart) {
  Claim dut(Of("robot", instance), at - Claim::kAskFor);
  Elapse(dut, at - Claim::kAskFor, at);
  EXPECT_EQ(dut.state(), State::kHeld);
  return dut;
}

TEST(Claim, AsksFor200MsAndThenHoldsWhatNobodyHas) {
  Claim dut(Of("robot", 5), kStart);
  const auto asked = Elapse(dut, kStart, kStart + milliseconds(199));
  EXPECT_EQ(dut.state(), State::kAsking);
  EXPECT_EQ(asked.size(), 5u) << "more than once: the first may be lost";
  for (const ClaimWord& word : asked) EXPECT_FALSE(word.holds);
  const auto said = Elapse(dut, kStart + milliseconds(200), kStart + milliseconds(1200));
  EXPECT_EQ(dut.state(), State::kHeld);
  EXPECT_EQ(said.size(), 6u) << "at once, and five times a second";
  EXPECT_TRUE(said.front().holds);
  EXPECT_EQ(said.back().age, milliseconds(1200));
}

TEST(Claim, IsRefusedByOneThatHoldsAndNamesIt) {
  Claim dut(Of("robot", 5), kStart);
  dut.Hear(Holds(1, seconds(0)), kStart + milliseconds(150));
  dut.Hear(Holds(1, seconds(0)), kStart + milliseconds(151));
  EXPECT_EQ(dut.state(), State::kAsking) << "these could be the last words of one that was killed";
  dut.Hear(Holds(1, seconds(0)), kStart + milliseconds(170));
  EXPECT_EQ(dut.state(), State::kRefused) << "however young it is, and however small its instance";
  EXPECT_EQ(dut.winner()->who.pid, 101);
  EXPECT_FALSE(dut.Step(kStart + milliseconds(300)));
}

TEST(Claim, TheLastWordOfOneThatIsGoneRefusesNobody) {
  Claim dut(Of("robot", 5), kStart);
  dut.Hear(Holds(1, seconds(9)), kStart + milliseconds(150));
  Elapse(dut, kStart + milliseconds(150), kStart + milliseconds(349));
  EXPECT_EQ(dut.state(), State::kAsking) << "it has been silent for less than 200 ms";
  Elapse(dut, kStart + milliseconds(350), kStart + milliseconds(350));
  EXPECT_EQ(dut.state(), State::kHeld);
}

TEST(Claim, OfTwoThatAskTheOneThatBeganFirstStays) {
  Claim dut(Of("robot", 5), kStart);
  dut.Hear(Asks(9, milliseconds(20)), kStart + milliseconds(50));
  EXPECT_EQ(dut.state(), State::kAsking);
  dut.Hear(Asks(9, milliseconds(80)), kStart + milliseconds(70));
  EXPECT_EQ(dut.state(), State::kRefused);
}

TEST(Claim, AnswersWhoAsksAtOnceButNotFasterThanEvery10Ms) {
  Claim dut = Held(5);
  Elapse(dut, kStart + milliseconds(1), kStart + milliseconds(20));
  dut.Hear(Asks(7, {}), kStart + milliseconds(20));
  const auto answer = dut.Step(kStart + milliseconds(20));
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->holds);
  dut.Hear(Asks(7, {}), kStart + milliseconds(22));
  EXPECT_FALSE(dut.Step(kStart + milliseconds(22)));
  EXPECT_TRUE(dut.Step(kStart + milliseconds(30)));
}

TEST(Claim, YieldsToOneThatHeldLongerAndTellsALoserOnce) {
  Claim dut = Held(5);
  dut.Hear(Holds(7, milliseconds(100)), kStart + milliseconds(10));
  EXPECT_EQ(dut.state(), State::kHeld);
  ASSERT_TRUE(dut.TakeLoser());
  dut.Hear(Holds(7, milliseconds(110)), kStart + milliseconds(20));
  EXPECT_FALSE(dut.TakeLoser()) << "the same one again";
  dut.Hear(Holds(8, seconds(1)), kStart + milliseconds(30));
  EXPECT_EQ(dut.state(), State::kYielded);
  EXPECT_EQ(dut.winner()->who.instance, 8);
}

TEST(Claim, EqualAgesAreDecidedByTheInstance) {
  Claim lesser = Held(5), greater = Held(7);
  lesser.Hear(Holds(7, Claim::kAskFor), kStart);
  greater.Hear(Holds(5, Claim::kAskFor), kStart);
  EXPECT_EQ(lesser.state(), State::kYielded);
  EXPECT_EQ(greater.state(), State::kHeld);
}

TEST(Claim, ItsAgeStandsStillWhileARivalIsHeardAndRunsOnAfterwards) {
  Claim dut = Held(5);
  dut.Hear(Holds(7, milliseconds(10)), kStart + milliseconds(50));
  auto said = Elapse(dut, kStart + milliseconds(51), kStart + seconds(1));
  for (const ClaimWord& word : said) EXPECT_EQ(word.age, milliseconds(250));
  said = Elapse(dut, kStart + seconds(1), kStart + seconds(4));
  EXPECT_GT(said.back().age, seconds(4));
}

TEST(Claim, AnotherRoleIsNoRivalAndAnotherRobotOnTheSameBusIsOne) {
  Claim dut = Held(5);
  dut.Hear({Of("head", 7), true, seconds(100)}, kStart);
  EXPECT_EQ(dut.state(), State::kHeld);
  dut.Hear({Of("head", 8, "another"), true, seconds(100)}, kStart);
  EXPECT_EQ(dut.state(), State::kYielded) << "both names lead to this port";
}

TEST(Claim, ItsOwnWordComesBackAndIsNotARival) {
  Claim dut = Held(5);
  dut.Hear(Holds(5, seconds(100)), kStart);
  EXPECT_EQ(dut.state(), State::kHeld);
}

TEST(Claim, OneThatStoodStillBeginsAnewAndYieldsToWhoTookItsPlace) {
  Claim dut = Held(5);
  Elapse(dut, kStart, kStart + seconds(100));
  const Time again = kStart + seconds(103);
  EXPECT_TRUE(dut.Touch(again));
  const auto word = dut.Step(again);
  ASSERT_TRUE(word) << "it says so at once";
  EXPECT_EQ(word->age, Duration::zero());
  dut.Hear(Holds(7, seconds(2)), again + milliseconds(1));
  EXPECT_EQ(dut.state(), State::kYielded);
}

TEST(Claim, AShortStallCostsNothing) {
  Claim dut = Held(5);
  Elapse(dut, kStart, kStart + seconds(100));
  EXPECT_FALSE(dut.Touch(kStart + seconds(100) + milliseconds(900)));
  EXPECT_GT(dut.Step(kStart + seconds(101))->age, seconds(100));
}

TEST(ClaimMessages, ComeBackAsTheyWent) {
  const ClaimWord word{Of("head", -3, "ivan"), true, milliseconds(1234)};
  const ClaimWord back = FromMessage(ToMessage(word, kStart));
  EXPECT_EQ(back.who.robot, "ivan");
  EXPECT_EQ(back.who.role, "head");
  EXPECT_EQ(back.who.instance, -3);
  EXPECT_EQ(back.who.host, "hall9");
  EXPECT_EQ(back.who.pid, 97);
  EXPECT_TRUE(back.holds);
  EXPECT_EQ(back.age, milliseconds(1234));
}

TEST(ClaimMessages, TwoProcessesAreNeverTheSameClaimant) {
  EXPECT_NE(MakeClaimant("priamos", "robot").instance, MakeClaimant("priamos", "robot").instance);
}

}  // namespace
}  // namespace priamos::bus
