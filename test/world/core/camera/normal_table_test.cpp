#include "world/core/camera/normal_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::world {
namespace {

TEST(NormalTable, DrawsFromTheStandardNormalDistribution) {
  constexpr int kDraws = 400000;
  Rng rng(11);
  NormalTable dut(rng);
  double sum = 0, squares = 0, fourth = 0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = dut.Draw();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
    beyond_two += std::abs(x) > 2;
  }
  EXPECT_NEAR(sum / kDraws, 0, 0.008);
  EXPECT_NEAR(squares / kDraws, 1, 0.01);
  EXPECT_NEAR(fourth / kDraws, 3, 0.08);
  EXPECT_NEAR(double(beyond_two) / kDraws, 0.0455, 0.002);
}

TEST(NormalTable, NeighboursAreIndependent) {
  constexpr int kDraws = 200000;
  Rng rng(12);
  NormalTable dut(rng);
  double product = 0, last = dut.Draw();
  for (int i = 0; i < kDraws; ++i) {
    const double x = dut.Draw();
    product += x * last;
    last = x;
  }
  EXPECT_NEAR(product / kDraws, 0, 0.01);
}

}  // namespace
}  // namespace priamos::world
