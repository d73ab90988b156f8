#include "robot/core/motion/standstill.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::robot {
namespace {

constexpr Time At(double seconds) {
  return FromUtime(1'000'000'000 + static_cast<std::int64_t>(seconds * 1e6));
}

TEST(Standstill, ABaseThatDrivesOrTurnsDoesNotStay) {
  Standstill driving, turning;
  for (double t = 0; t < 20; t += 0.02) {
    EXPECT_LT(driving.Stays({0.05 * t, 0, 0}, At(t)), FromSeconds(3)) << t;
    EXPECT_LT(turning.Stays({0, 0, 0.1 * t}, At(t)), FromSeconds(3)) << t;
  }
}

TEST(Standstill, ABaseThatGoesToAndFroStays) {
  Standstill dut;
  for (double t = 0; t < 20; t += 0.02)
    EXPECT_EQ(dut.Stays({0.04 * std::sin(2 * t), 0, 0}, At(t)), At(t) - At(0)) << t;
}

TEST(Standstill, BeginsAnewWhenItIsReset) {
  Standstill dut;
  dut.Stays({}, At(0));
  EXPECT_EQ(dut.Stays({}, At(4)), FromSeconds(4));
  dut.Reset();
  EXPECT_EQ(dut.Stays({}, At(5)), Duration(0));
  EXPECT_EQ(dut.Stays({}, At(8)), FromSeconds(3));
}

}  // namespace
}  // namespace priamos::robot
