#include "cli/terminal/play_keys.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

class PlayKeys : public testing::Test {
 protected:
  static std::string Log() {
    std::string text;
    for (int i = 0; i < 100; ++i) bus::AppendEvent(text, i, 1'000'000 + i * 1'000'000, "A", {});
    return text;
  }
  bool Press(std::string_view keys) { return ApplyKeys(keys, dut_, now_); }
  std::string text_ = Log();
  bus::LogPlayer dut_{bus::LogReader(std::as_bytes(std::span(text_))), {}};
  Time now_ = FromUtime(1);
};

TEST_F(PlayKeys, SpacePausesAndGoesOn) {
  EXPECT_TRUE(Press(" "));
  EXPECT_TRUE(dut_.paused());
  Press(" ");
  EXPECT_FALSE(dut_.paused());
}

TEST_F(PlayKeys, ArrowsSeek) {
  Press("\x1b[A\x1b[A\x1b[B\x1b[C\x1b[C\x1b[D");
  EXPECT_EQ(dut_.position(), std::chrono::seconds(11));
  Press("0");
  EXPECT_EQ(dut_.position(), std::chrono::seconds(0));
}

TEST_F(PlayKeys, SpeedDoublesAndHalvesWithinItsLimits) {
  Press("--");
  EXPECT_EQ(dut_.speed(), 0.25);
  Press(std::string(20, '-'));
  EXPECT_EQ(dut_.speed(), 1.0 / 64);
  Press("1+");
  EXPECT_EQ(dut_.speed(), 2);
  Press("m");
  EXPECT_EQ(dut_.speed(), bus::LogPlayer::kFlatOut);
}

TEST_F(PlayKeys, QuitsAndIgnoresOtherKeys) {
  EXPECT_TRUE(Press("xyz\x1b[Z"));
  EXPECT_FALSE(Press("xq"));
}

TEST(SpeedText, IsReadable) {
  EXPECT_EQ(SpeedText(0.25), "1/4");
  EXPECT_EQ(SpeedText(2), "2");
}

}  // namespace
}  // namespace priamos::cli
