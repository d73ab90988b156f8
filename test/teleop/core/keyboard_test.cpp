#include "teleop/core/keyboard.hpp"

#include <gtest/gtest.h>

namespace priamos::teleop {
namespace {

using std::chrono::milliseconds;

struct KeyboardTest : testing::Test {
  ButtonUse buttons;
  Keyboard dut{buttons, milliseconds(250)};
  Time now = FromUtime(1'000'000);

  void Type(const char* keys) {
    for (; *keys; ++keys) dut.Type(*keys, now);
  }
};

TEST_F(KeyboardTest, AKeyDrivesAndHoldsTheDeadMan) {
  Type("w");
  EXPECT_EQ(dut.At(now).axis[0], 1);
  EXPECT_TRUE(IsPressed(dut.At(now), buttons.dead_man));
}

TEST_F(KeyboardTest, AKeyThatIsNotRepeatedIsLetGo) {
  Type("w");
  EXPECT_EQ(dut.At(now + milliseconds(251)).axis[0], 0);
  EXPECT_EQ(dut.At(now + milliseconds(251)).buttons, 0u);
}

TEST_F(KeyboardTest, RepetitionHoldsOnAndTwoKeysAddUp) {
  for (int i = 0; i < 10; ++i) {
    Type("wq");
    now += milliseconds(100);
    EXPECT_EQ(dut.At(now).axis[0], 1);
    EXPECT_EQ(dut.At(now).axis[5], 1);
  }
}

TEST_F(KeyboardTest, AnyOtherKeyStands) {
  Type("wx");
  EXPECT_EQ(dut.At(now).axis[0], 0);
}

TEST_F(KeyboardTest, SpaceIsTheEstopAndLetsGo) {
  Type("w ");
  EXPECT_TRUE(IsPressed(dut.At(now), buttons.estop));
  EXPECT_EQ(dut.At(now).axis[0], 0);
}

TEST_F(KeyboardTest, ArrowsArePitchAndRoll) {
  Type("\033[A");
  EXPECT_EQ(dut.At(now).axis[4], 1);
  Type("\033[D");
  EXPECT_EQ(dut.At(now).axis[3], -1);
}

TEST_F(KeyboardTest, ABrokenSequenceDoesNotSwallowTheEstop) {
  Type("\033 ");
  EXPECT_TRUE(IsPressed(dut.At(now), buttons.estop));
}

}  // namespace
}  // namespace priamos::teleop
