#include "teleop/emulated_mouse.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace priamos::teleop {
namespace {

using std::chrono::milliseconds;
using testing::StartsWith;

struct EmulatedMouseTest : testing::Test {
  EmulatedMouse dut{350};
  Stick hand;
  Time now = FromUtime(1'000'000);

  int Motions(int ms) {
    int motions = 0;
    for (int t = 0; t < ms; t += 10) {
      now += milliseconds(10);
      const std::string said = dut.Move(hand, now);
      motions += static_cast<int>(std::count(said.begin(), said.end(), 'd'));
    }
    return motions;
  }
};

TEST_F(EmulatedMouseTest, SaysNothingUnasked) {
  hand.axis[0] = 1;
  EXPECT_EQ(Motions(200), 0);
}

TEST_F(EmulatedMouseTest, AnswersTheVersionAndWakesUp) {
  EXPECT_THAT(dut.Hear("\rvQ"), "");
  EXPECT_THAT(dut.Hear("\r"), StartsWith("v"));
  EXPECT_FALSE(dut.awake());
  EXPECT_THAT(dut.Hear("m3\r"), StartsWith("m3\r"));
  EXPECT_TRUE(dut.awake());
}

TEST_F(EmulatedMouseTest, KeepsTalkingWhileDeflectedAndSaysOnceThatItRests) {
  dut.Hear("m3\r");
  EXPECT_EQ(Motions(400), 0);
  hand.axis[0] = 1;
  EXPECT_EQ(Motions(400), 10);
  hand = {};
  EXPECT_EQ(Motions(400), 1);
}

}  // namespace
}  // namespace priamos::teleop
