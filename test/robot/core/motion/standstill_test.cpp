#include "robot/core/motion/standstill.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::robot {
namespace {

constexpr Time At(double seconds) {
  return FromUtime(1'000'000'000 + static_cast<std::int64_t>(seconds * 1e6));
}

TEST(Standstill, ABaseThatDrivesOrTurnsDoesNotStay) {
  Standstill driving(3), turning(3);
  for (double t = 0; t < 20; t += 0.02) {
    EXPECT_FALSE(driving.Stays({0.05 * t, 0, 0}, At(t))) << t;
    EXPECT_FALSE(turning.Stays({0, 0, 0.1 * t}, At(t))) << t;
  }
}

TEST(Standstill, ABaseThatGoesToAndFroStays) {
  Standstill dut(3);
  for (double t = 0; t < 20; t += 0.02)
    EXPECT_EQ(dut.Stays({0.04 * std::sin(2 * t), 0, 0}, At(t)), t > 3.01) << t;
}

TEST(Standstill, BeginsAnewWhenItIsReset) {
  Standstill dut(3);
  dut.Stays({}, At(0));
  EXPECT_TRUE(dut.Stays({}, At(4)));
  dut.Reset();
  EXPECT_FALSE(dut.Stays({}, At(5)));
  EXPECT_TRUE(dut.Stays({}, At(8.1)));
}

}  // namespace
}  // namespace priamos::robot
