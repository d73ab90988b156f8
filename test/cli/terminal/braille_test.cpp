#include "cli/terminal/braille.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace priamos::cli {
namespace {

TEST(BrailleTest, EmptyIsBlank) {
  EXPECT_EQ(Braille(2, 1).Text(false), "\u2800\u2800\n");
}

TEST(BrailleTest, ALineDownTheLeftColumnAndOneAlongTheTop) {
  Braille down(1, 1), along(2, 1);
  down.Line(0, 0, 0, 3, Braille::kGreen);
  along.Line(0, 0, 3, 0, Braille::kGreen);
  EXPECT_EQ(down.Text(false), "\u2847\n");
  EXPECT_EQ(along.Text(false), "\u2809\u2809\n");
}

TEST(BrailleTest, ALineIsCutToThePicture) {
  Braille dut(2, 1);
  dut.Line(-100, 0, 100, 0, Braille::kGreen);
  EXPECT_EQ(dut.Text(false), "\u2809\u2809\n");
  Braille outside(2, 1);
  outside.Line(-5, -5, -1, 20, Braille::kGreen);
  outside.Line(0, 9, 3, 9, Braille::kGreen);
  EXPECT_EQ(outside.Text(false), Braille(2, 1).Text(false));
}

TEST(BrailleTest, WhatIsNoNumberDrawsNothing) {
  Braille dut(2, 1);
  dut.Line(std::numeric_limits<double>::quiet_NaN(), 0, 3, 0, Braille::kGreen);
  dut.Line(0, 0, std::numeric_limits<double>::infinity(), 0, Braille::kGreen);
  EXPECT_EQ(dut.Text(false), Braille(2, 1).Text(false));
}

TEST(BrailleTest, TheHigherInkColoursTheCharacter) {
  Braille dut(1, 1);
  dut.Line(0, 0, 0, 0, Braille::kGreen);
  dut.Line(1, 0, 1, 0, Braille::kDim);
  EXPECT_NE(dut.Text(true).find("\x1b[1;32m"), std::string::npos);
  EXPECT_EQ(dut.Text(true).find("\x1b[2m"), std::string::npos);
  EXPECT_EQ(dut.Text(false).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace priamos::cli
