#include "bus/radio/frame/forgery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {
namespace {

constexpr double kDay_s = 86400;

TEST(Forgery, HalfOfAllAttacksSucceedWithinTheTimeComputed) {
  for (const std::size_t code_bytes : {4U, 6U, 8U}) {
    const double tries = ForgerySeconds(960, code_bytes) * TriesPerSecond(960, code_bytes);
    const double p = std::exp2(-8.0 * static_cast<double>(code_bytes));
    EXPECT_NEAR(std::exp(tries * std::log1p(-p)), 0.5, 1e-6) << code_bytes;
  }
}

TEST(Forgery, At9600BaudFourBytesTakeTheBetterPartOfAYear) {
  EXPECT_NEAR(TriesPerSecond(960, 4), 960.0 / 7, 1e-9) << "7 bytes are a frame without contents";
  EXPECT_NEAR(ForgerySeconds(960, 4) / kDay_s, 251, 1);
}

TEST(Forgery, TheDefaultIsTheShortestThatLastsLongEnough) {
  EXPECT_EQ(DefaultCodeBytes(30), kShortCodeBytes);
  EXPECT_EQ(DefaultCodeBytes(960), kShortCodeBytes);
  EXPECT_EQ(DefaultCodeBytes(1300), kShortCodeBytes);
  EXPECT_EQ(DefaultCodeBytes(1400), 6U);
  EXPECT_EQ(DefaultCodeBytes(1e6), 6U);
  EXPECT_EQ(DefaultCodeBytes(1e9), 8U);
  for (double rate = 30; rate < 1e9; rate *= 1.1)
    EXPECT_GE(ForgerySeconds(rate, DefaultCodeBytes(rate)), kLeastForgery_s) << rate;
}

}  // namespace
}  // namespace priamos::bus::radio
