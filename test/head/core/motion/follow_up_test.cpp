#include "head/core/motion/follow_up.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

using enum Following;

constexpr Approach kNear{0.9, 0.3, false}, kFar{1.5, 0.3, false}, kStanding{0.9, 0, false};
constexpr Approach kInDoor{0.4, 0.3, true}, kBlindInDoor{0.4, 0.3, false};

Time At(double s) {
  return Time{} + FromSeconds(s);
}

TEST(FollowUp, WhatWasFoundFromNearIsLookedAtAgain) {
  FollowUp dut({});
  EXPECT_EQ(dut.Due(kNear, At(1)), kNothing);
  dut.Answered(true, At(1));
  EXPECT_EQ(dut.Due(kNear, At(1.2)), kNothing);
  EXPECT_EQ(dut.Due(kNear, At(1.3)), kLandmark);
  EXPECT_EQ(dut.Due(kNear, At(2)), kNothing) << "one look for each that found it";
  dut.Answered(true, At(1.4));
  EXPECT_EQ(dut.Due(kNear, At(1.8)), kLandmark);
}

TEST(FollowUp, WhatIsLostIsNotFollowed) {
  FollowUp dut({});
  dut.Answered(true, At(1));
  dut.Answered(false, At(1.1));
  EXPECT_EQ(dut.Due(kNear, At(2)), kNothing);
}

TEST(FollowUp, FromAfarOrStandingItWaitsForOrders) {
  for (const Approach& approach : {kFar, kStanding}) {
    FollowUp dut({});
    dut.Answered(true, At(1));
    EXPECT_EQ(dut.Due(approach, At(1.5)), kNothing);
    EXPECT_EQ(dut.Due(kNear, At(1.6)), kNothing) << "until it is found again";
  }
}

TEST(FollowUp, CanBeSwitchedOff) {
  FollowUp dut({.within_m = 0});
  dut.Answered(true, At(1));
  EXPECT_EQ(dut.Due(kNear, At(2)), kNothing);
}

TEST(FollowUp, TooNearItLooksBeyondWhereItKnowsWhatIsThere) {
  FollowUp dut({});
  dut.Answered(true, At(1));
  EXPECT_EQ(dut.Due(kInDoor, At(1.5)), kBeyond);
  dut.AnsweredBeyond(true, At(1.6));
  EXPECT_EQ(dut.Due(kInDoor, At(2)), kBeyond);
  dut.Answered(true, At(2.1));
  EXPECT_EQ(dut.Due(kBlindInDoor, At(2.5)), kLandmark) << "for what else?";
}

TEST(FollowUp, ALandmarkThatIsLostBeforeLeavesWhatStandsBeyondIt) {
  FollowUp dut({});
  dut.Answered(false, At(1));
  EXPECT_EQ(dut.Due({0.9, 0.3, true}, At(1.5)), kBeyond);
}

TEST(FollowUp, LooksBeyondEndBehindTheLandmarkAndAfterThreeThatToldNothing) {
  FollowUp dut({});
  dut.AnsweredBeyond(true, At(1));
  EXPECT_EQ(dut.Due({-0.3, 0.3, true}, At(1.5)), kNothing);
  for (int i = 0; i < 2; ++i) {
    dut.AnsweredBeyond(false, At(2 + i));
    EXPECT_EQ(dut.Due(kInDoor, At(2.5 + i)), kBeyond);
  }
  dut.AnsweredBeyond(false, At(5));
  EXPECT_EQ(dut.Due(kInDoor, At(6)), kNothing);
}

TEST(FollowUp, AnOrderedLookGoesBeyondAsWellWhereTheLandmarkCannotBeFound) {
  constexpr Approach kBefore{0.9, 0.3, true};
  FollowUp dut({});
  EXPECT_TRUE(dut.GoesBeyond(kInDoor));
  EXPECT_FALSE(dut.GoesBeyond(kBlindInDoor));
  EXPECT_FALSE(dut.GoesBeyond(kBefore));
  dut.Answered(false, At(1));
  EXPECT_TRUE(dut.GoesBeyond(kBefore));
  EXPECT_FALSE(dut.GoesBeyond({1.5, 0.3, true})) << "from there it may be found again";
  for (int i = 0; i < 3; ++i) dut.AnsweredBeyond(false, At(2 + i));
  EXPECT_FALSE(dut.GoesBeyond(kBefore)) << "neither the one nor the other";
}

TEST(FollowUp, LooksBeyondCanBeSwitchedOff) {
  FollowUp dut({.beyond_m = 0});
  dut.Answered(true, At(1));
  EXPECT_EQ(dut.Due(kInDoor, At(1.5)), kLandmark);
}

}  // namespace
}  // namespace priamos::head
