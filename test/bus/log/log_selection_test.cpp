#include "bus/log/log_selection.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

TEST(MatchesPattern, StarsStandForAnyText) {
  EXPECT_TRUE(MatchesPattern("POSE", "POSE"));
  EXPECT_FALSE(MatchesPattern("POSE", "POSE_2"));
  EXPECT_TRUE(MatchesPattern("WHEEL_*", "WHEEL_STATE"));
  EXPECT_TRUE(MatchesPattern("*_STATE", "WHEEL_STATE"));
  EXPECT_TRUE(MatchesPattern("W*_S*E", "WHEEL_SE_SATE"));
  EXPECT_TRUE(MatchesPattern("*", ""));
  EXPECT_FALSE(MatchesPattern("", "A"));
  EXPECT_FALSE(MatchesPattern("A.B", "AxB"));  // unlike LCM's regular expressions
}

TEST(MatchesPattern, ManyStarsStayFast) {
  EXPECT_FALSE(MatchesPattern("*a*a*a*a*a*a*a*a*a*a*b", std::string(5000, 'a')));
}

TEST(LogSelection, WantsEverythingByDefault) {
  EXPECT_TRUE(LogSelection{}.Wants(-5, "ANY"));
}

TEST(LogSelection, LeavingOutIsStronger) {
  LogSelection dut;
  dut.only = {"WHEEL_*", "POSE"};
  dut.without = {"*_STATE"};
  EXPECT_TRUE(dut.Wants(0, "WHEEL_COMMAND"));
  EXPECT_TRUE(dut.Wants(0, "POSE"));
  EXPECT_FALSE(dut.Wants(0, "WHEEL_STATE"));
  EXPECT_FALSE(dut.Wants(0, "HEALTH"));
}

TEST(LogSelection, TheEndIsNotIncluded) {
  LogSelection dut;
  dut.from_utime = 10;
  dut.to_utime = 20;
  EXPECT_FALSE(dut.Wants(9, "A"));
  EXPECT_TRUE(dut.Wants(10, "A"));
  EXPECT_FALSE(dut.Wants(20, "A"));
}

TEST(LogSelection, RenamesChannels) {
  LogSelection dut;
  dut.rename = {{"A", "B"}};
  EXPECT_EQ(dut.NameOf("A"), "B");
  EXPECT_EQ(dut.NameOf("C"), "C");
}

}  // namespace
}  // namespace priamos::bus
