#include "head/core/tracks/turn_taking.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

namespace priamos::head {
namespace {

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

Tellable Thing(int id, double x_m = 0, int state = 0) {
  return {id, {x_m, 0}, state};
}

TEST(TurnTaking, AThingIsToldAndThenAgain) {
  TurnTaking dut;
  EXPECT_FALSE(dut.Next({}, At(0)));
  const std::array things{Thing(7)};
  EXPECT_EQ(dut.Next(things, At(1)), 7);
  EXPECT_FALSE(dut.Next(things, At(3))) << "the radio carries one every 5 s";
  EXPECT_EQ(dut.Next(things, At(6.1)), 7) << "the radio may have lost the first";
}

TEST(TurnTaking, WhatIsNewGoesFirst) {
  TurnTaking dut;
  ASSERT_EQ(dut.Next(std::array{Thing(1)}, At(0)), 1);
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2, 4)}, At(5)), 2);
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2, 4, 1)}, At(10)), 2) << "its state has changed";
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2, 4.1, 1)}, At(15)), 2) << "it stands elsewhere";
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2, 4.11, 1)}, At(20)), 1);
}

TEST(TurnTaking, OfTwoThatAreNewsTheHeavierOneGoesFirst) {
  TurnTaking dut;
  Tellable heavy = Thing(2);
  heavy.weight = 1;
  const std::array things{Thing(1), heavy};
  EXPECT_EQ(dut.Next(things, At(0)), 2);
  EXPECT_EQ(dut.Next(things, At(5)), 1);
  EXPECT_EQ(dut.Next(things, At(10)), 2) << "then in turn";
}

TEST(TurnTaking, OfNewsOnlyNothingIsToldAgain) {
  TurnTaking dut({.every_s = 0.4, .news_only = true});
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2)}, At(0)), 1);
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2)}, At(0.5)), 2);
  EXPECT_FALSE(dut.Next(std::array{Thing(1), Thing(2)}, At(20)));
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2, 0.1)}, At(21)), 2) << "it is elsewhere";
}

TEST(TurnTaking, AllHaveTheirTurn) {
  TurnTaking dut;
  const std::array things{Thing(1), Thing(2), Thing(3)};
  std::set<int> told;
  for (int i = 0; i < 3; ++i) told.insert(*dut.Next(things, At(5.0 * i)));
  EXPECT_EQ(told.size(), 3u);
}

TEST(TurnTaking, WhatIsForgottenIsNewAgain) {
  TurnTaking dut;
  ASSERT_EQ(dut.Next(std::array{Thing(1)}, At(0)), 1);
  ASSERT_EQ(dut.Next(std::array{Thing(1), Thing(2)}, At(5)), 2);
  dut.Forget();
  EXPECT_EQ(dut.Next(std::array{Thing(1), Thing(2)}, At(10)), 1);
}

}  // namespace
}  // namespace priamos::head
