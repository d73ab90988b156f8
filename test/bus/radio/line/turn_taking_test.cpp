#include "bus/radio/line/turn_taking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;

const Time kStart = FromUtime(1'000'000'000);
constexpr HalfDuplex kMode{.turn = Duration(400'000), .turnaround = Duration(20'000)};

TEST(TurnTaking, FullDuplexMayAlwaysTalk) {
  const TurnTaking dut({}, false, kStart);
  EXPECT_TRUE(dut.MayTalk(kStart));
  EXPECT_FALSE(dut.MustEnd(kStart + Duration(10'000'000), Duration(100'000)));
}

TEST(TurnTaking, OverHandsTheTurnToTheOther) {
  TurnTaking onboard(kMode, true, kStart), offboard(kMode, false, kStart);
  EXPECT_TRUE(onboard.MayTalk(kStart));
  EXPECT_FALSE(offboard.MayTalk(kStart));
  const Time end = kStart + Duration(100'000);
  onboard.OnOverSent(end);
  offboard.OnOverReceived(end);
  EXPECT_FALSE(onboard.MayTalk(end));
  EXPECT_FALSE(offboard.MayTalk(end));  // the other one cannot hear yet
  EXPECT_TRUE(offboard.MayTalk(end + kMode.turnaround));
}

TEST(TurnTaking, ATurnIsBounded) {
  const TurnTaking dut(kMode, true, kStart);
  EXPECT_FALSE(dut.MustEnd(kStart + Duration(200'000), Duration(130'000)));
  EXPECT_TRUE(dut.MustEnd(kStart + Duration(300'000), Duration(130'000)));
}

TEST(TurnTaking, ALostOverIsMadeGoodOneAfterTheOther) {
  TurnTaking onboard(kMode, true, kStart), offboard(kMode, false, kStart);
  onboard.OnOverSent(kStart);
  Time now = kStart;
  while (!offboard.MayTalk(now) && now < kStart + Duration(2'000'000)) {
    now += Duration(1000);
    onboard.Step(now, Duration(0));
    offboard.Step(now, Duration(0));
  }
  EXPECT_LT(now - kStart, Duration(200'000));
  EXPECT_FALSE(onboard.MayTalk(now + Duration(50'000)));
  onboard.Step(now + Duration(200'000), Duration(0));
  EXPECT_TRUE(onboard.MayTalk(now + Duration(200'000)));
}

TEST(TurnTaking, BytesOfSomebodyElseDelayTheTurnByOneTurnAtMost) {
  TurnTaking dut(kMode, false, kStart);
  dut.OnOverSent(kStart);
  Time now = kStart;
  while (!dut.MayTalk(now) && now < kStart + Duration(5'000'000)) {
    now += Duration(1000);
    dut.OnBytes(now);
    dut.Step(now, Duration(0));
  }
  EXPECT_GT(now - kStart, kMode.turn);
  EXPECT_LT(now - kStart, kMode.turn + Duration(100'000));
}

LinkPair HalfDuplexPair(LineConfig line = {}, std::uint64_t seed = 1) {
  line.half_duplex = true;
  return LinkPair(line, seed, LinkOptions{.half_duplex = kMode});
}

TEST(HalfDuplexLink, BothDirectionsShareTheAir) {
  LinkPair dut = HalfDuplexPair();
  dut.each_step = [&] {
    dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
    dut.onboard.link->Offer(kSlowUp, Text(std::string(100, 's')), dut.now);
    if (ToUtime(dut.now) % 100'000 == 0) dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  };
  dut.offboard.link->Offer(kEventDown, Text(std::string(600, 'e')), dut.now);
  dut.Run(20);
  EXPECT_GT(dut.offboard.TextsOf(kPoseUp).size(), 60U);
  EXPECT_GT(dut.offboard.TextsOf(kSlowUp).size(), 15U);
  EXPECT_GT(dut.onboard.TextsOf(kDriveDown).size(), 50U);
  EXPECT_THAT(dut.onboard.TextsOf(kEventDown), ElementsAre(std::string(600, 'e')));
  const LinkCounters up = dut.offboard.link->Status(dut.now).counters;
  EXPECT_EQ(up.frames_missed, 0U);  // nobody talked into the other
}

TEST(HalfDuplexLink, EventsSurviveErrorsAndRestarts) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    LinkPair dut = HalfDuplexPair({.bit_error_rate = 3e-4}, seed);
    Rng rng = Rng::Stream(seed, "restarts");
    std::vector<std::string> up, down;
    for (int i = 0; i < 30; ++i) {
      up.push_back("up " + std::to_string(i) + std::string(rng.Below(100), '.'));
      down.push_back("down " + std::to_string(i) + std::string(rng.Below(100), '.'));
      dut.onboard.link->Offer(kEventUp, Text(up.back()), dut.now);
      dut.offboard.link->Offer(kEventDown, Text(down.back()), dut.now);
      dut.Run(0.7);
      if (rng.Chance(0.1)) dut.Start(dut.onboard);
      if (rng.Chance(0.1)) dut.Start(dut.offboard);
    }
    dut.Run(20);
    EXPECT_EQ(dut.offboard.TextsOf(kEventUp), up) << seed;
    EXPECT_EQ(dut.onboard.TextsOf(kEventDown), down) << seed;
  }
}

}  // namespace
}  // namespace priamos::bus::radio
