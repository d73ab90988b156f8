#include "planner/core/missions/look_sequence.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

const Time kStart = FromUtime(1'000'000'000);

struct Looks {
  LookSequence dut{LookConfig{5, 4, 6}};
  Time now = kStart;
  int id = 0;

  /// Asks, answers, settles.
  void Look(bool ok, const char* reason = "", bool no_model = false) {
    now += FromSeconds(2);
    dut.Asked(++id, now);
    dut.OnResult({id, ok, reason, no_model});
    EXPECT_TRUE(dut.Settle(now).has_value());
  }
};

TEST(LookSequence, SidesComeInTurnWhateverBecomesOfThem) {
  Looks s;
  EXPECT_EQ(s.dut.next(), Side::kLeft);
  s.Look(true);
  EXPECT_EQ(s.dut.next(), Side::kRight);
  s.Look(false);
  EXPECT_EQ(s.dut.next(), Side::kLeft);
}

TEST(LookSequence, StaysOnASideUntilItIsNotFound) {
  Looks s;
  s.dut.StayOnSide();
  EXPECT_EQ(s.dut.next(), Side::kLeft);
  for (const bool ok : {true, true, false}) {
    s.Look(ok);
    s.dut.StayOnSide();
    EXPECT_EQ(s.dut.next(), ok ? Side::kLeft : Side::kRight);
  }
}

TEST(LookSequence, WhereThereIsNoTimeToTurnItStaysOnALostSide) {
  Looks s;
  s.Look(false);
  s.dut.StayOnSide(true);
  EXPECT_EQ(s.dut.next(), Side::kLeft);
}

TEST(LookSequence, OneAtATime) {
  Looks s;
  EXPECT_TRUE(s.dut.Ready(s.now));
  s.dut.Asked(1, s.now);
  EXPECT_FALSE(s.dut.Ready(s.now));
  EXPECT_FALSE(s.dut.Settle(s.now).has_value());
  s.dut.OnResult({1, true, "", false});
  EXPECT_TRUE(s.dut.Settle(s.now)->ok);
  EXPECT_TRUE(s.dut.Ready(s.now));
}

TEST(LookSequence, AnswerToAnotherRequestIsIgnored) {
  Looks s;
  s.dut.Asked(7, s.now);
  s.dut.OnResult({6, true, "", false});
  EXPECT_FALSE(s.dut.Settle(s.now).has_value());
}

TEST(LookSequence, FirstAnswerCounts) {
  Looks s;
  s.dut.Asked(7, s.now);
  s.dut.OnResult({7, false, "ambiguous", false});
  s.dut.OnResult({7, false, "not found", false});
  EXPECT_EQ(s.dut.Settle(s.now)->reason, "ambiguous");
  EXPECT_EQ(s.dut.failures(), 1);
}

TEST(LookSequence, PausesAfterAFailure) {
  Looks s;
  s.Look(false);
  EXPECT_FALSE(s.dut.Ready(s.now + FromSeconds(0.2)));
  EXPECT_TRUE(s.dut.Ready(s.now + FromSeconds(0.4)));
}

TEST(LookSequence, PausesLongerWhenTheModelHasToBeSent) {
  Looks s;
  s.Look(false, "no model", true);
  EXPECT_FALSE(s.dut.Ready(s.now + FromSeconds(1.0)));
  EXPECT_TRUE(s.dut.Ready(s.now + FromSeconds(1.3)));
}

TEST(LookSequence, SilenceIsAFailureThatWeighsThree) {
  Looks s;
  s.dut.Asked(1, s.now);
  EXPECT_FALSE(s.dut.Settle(s.now + FromSeconds(4.9)).has_value());
  const auto result = s.dut.Settle(s.now + FromSeconds(5.1));
  ASSERT_TRUE(result.has_value());
  EXPECT_FALSE(result->ok);
  EXPECT_TRUE(result->no_model);
  EXPECT_EQ(s.dut.failures(), 3);
}

TEST(LookSequence, BothSidesAreEnough) {
  Looks s;
  s.Look(true);
  EXPECT_FALSE(s.dut.Enough());
  s.Look(true);
  EXPECT_TRUE(s.dut.Enough());
}

TEST(LookSequence, ThreeLooksAtOneSideMakeUpForTheOther) {
  Looks s;
  for (int i = 0; i < 2; ++i) {
    s.Look(true);
    s.Look(false);
    EXPECT_FALSE(s.dut.Enough());
  }
  s.Look(true);
  EXPECT_TRUE(s.dut.Enough());
}

TEST(LookSequence, FailuresExhaustIt) {
  Looks s;
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(s.dut.Exhausted());
    s.Look(false, "too few edges");
  }
  EXPECT_TRUE(s.dut.Exhausted());
  EXPECT_EQ(s.dut.trouble(), "right side of the door not found: too few edges");
}

TEST(LookSequence, EndlessSuccessExhaustsItToo) {
  Looks s;
  for (int i = 0; i < 6; ++i) s.Look(true);
  EXPECT_TRUE(s.dut.Exhausted());
}

TEST(LookSequence, ResetBeginsAfresh) {
  Looks s;
  s.Look(false);
  s.dut.Reset();
  EXPECT_EQ(s.dut.next(), Side::kLeft);
  EXPECT_EQ(s.dut.failures(), 0);
  EXPECT_TRUE(s.dut.Ready(kStart));
}

}  // namespace
}  // namespace priamos::planner
