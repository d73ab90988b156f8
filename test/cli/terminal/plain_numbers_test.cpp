#include "cli/terminal/plain_numbers.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace priamos::cli {
namespace {

std::string Shown(const bus::Json& json) {
  return WithPlainNumbers(json).dump();
}

TEST(PlainNumbers, StepsOfACentimetreShowNoRoundingError) {
  for (int i = 0; i <= 500; ++i) {
    const std::string shown = Shown(i * 0.01);
    EXPECT_LE(shown.size(), 4u) << shown;
    EXPECT_NEAR(std::stod(shown), i * 0.01, 1e-14);
  }
  EXPECT_EQ(Shown(114 * 0.01), "1.14");
  EXPECT_EQ(Shown({{"a", {0.1 + 0.2, -3 * 0.1}}, {"n", 3}, {"t", "NaN"}}),
            R"({"a":[0.3,-0.3],"n":3,"t":"NaN"})");
}

TEST(PlainNumbers, WhatIsNoDecimalKeepsAllDigits) {
  EXPECT_EQ(Shown(1.0 / 3), bus::Json(1.0 / 3).dump());
  EXPECT_EQ(Shown(1.2345678901234567), bus::Json(1.2345678901234567).dump());
  EXPECT_EQ(Shown(0.0), "0.0");
}

}  // namespace
}  // namespace priamos::cli
