#include "world/core/head/mast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr double kStep_s = 0.0025;

TEST(MastTest, NodsWhenTheBaseBrakesSwingsAndComesToRest) {
  Mast dut({0.2, 4, 0.1});
  double vx = 0.5;
  for (int i = 0; i < 2000; ++i) dut.Step({vx, 0, 0}, kStep_s);  // the start is long over
  EXPECT_NEAR(dut.lean().pitch_rad, 0, 1e-6);
  double most = 0;
  while (vx > 0) {
    vx -= 1.5 * kStep_s;
    dut.Step({vx, 0, 0}, kStep_s);
    most = std::max(most, dut.lean().pitch_rad);
  }
  // A sudden push leans it up to twice as far as a steady one.
  EXPECT_GT(most, Radians(0.2) * 1.5);
  EXPECT_LT(most, Radians(0.2) * 1.5 * 2);
  int swings = 0;
  for (int i = 0; i < 400; ++i) {
    const double before = dut.lean().pitch_rad;
    dut.Step({0, 0, 0}, kStep_s);
    swings += (before < 0) != (dut.lean().pitch_rad < 0);
  }
  EXPECT_NEAR(swings, 8, 1) << "4 Hz for a second";
  for (int i = 0; i < 4000; ++i) dut.Step({0, 0, 0}, kStep_s);
  EXPECT_NEAR(dut.lean().pitch_rad, 0, 1e-6);
}

TEST(MastTest, LeansToTheRightWhenTheBaseGoesLeft) {
  Mast dut({0.2, 4, 0.1});
  dut.Step({0, 0.01, 0}, kStep_s);
  EXPECT_GT(dut.lean().roll_rad, 0);
  EXPECT_EQ(dut.lean().pitch_rad, 0);
}

TEST(MastTest, AStiffOneNeverMoves) {
  Mast dut(MastPlan{});
  for (int i = 0; i < 100; ++i) dut.Step({i * 0.01, 0, 0}, kStep_s);
  EXPECT_EQ(dut.lean().pitch_rad, 0);
}

}  // namespace
}  // namespace priamos::world
