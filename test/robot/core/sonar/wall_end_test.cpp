#include "robot/core/sonar/wall_end.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

/// Of a wall `line_m` away that ends at 0 and was heard up to `beyond_m` beyond it.
std::vector<EchoBeside> Echoes(double line_m, double beyond_m, double line_error_m = 0, Rng* rng = nullptr) {
  std::vector<EchoBeside> echoes;
  for (double along_m = -2; along_m <= beyond_m; along_m += 0.03) {
    const double noise_m = rng ? rng->Normal(WallFitConfig{}.SigmaOf(line_m)) : 0;
    echoes.push_back({along_m, line_m + line_error_m, std::hypot(line_m, std::max(0.0, along_m)) + noise_m});
  }
  return echoes;
}

TEST(FindWallEnd, TheEdgeIsWhereTheRangesBend) {
  const WallEnd dut = FindWallEnd(Echoes(1.0, 0.3), {});
  EXPECT_NEAR(dut.along_m, 0, 0.03);
  EXPECT_LT(dut.sigma_m, 0.06);
}

TEST(FindWallEnd, WithoutABendItIsWhereItWasHeardLast) {
  const WallEnd dut = FindWallEnd(Echoes(1.0, 0), {});
  EXPECT_NEAR(dut.along_m, -0.02, 0.02);
  EXPECT_GT(dut.sigma_m, 0.08) << "as far as a beam hears beyond an edge";
}

TEST(FindWallEnd, AnErrorOfTheLineIsNoBend) {
  EXPECT_NEAR(FindWallEnd(Echoes(1.0, 0.3, 0.03), {}).along_m, 0, 0.03);
  EXPECT_NEAR(FindWallEnd(Echoes(1.0, 0, -0.03), {}).along_m, -0.02, 0.02);
}

TEST(FindWallEnd, AFewEchoesTellNoBend) {
  const std::vector<EchoBeside> few{{0, 1, 1}, {0.1, 1, 1}, {0.2, 1, 1.02}, {0.3, 1, 1.05}};
  EXPECT_EQ(FindWallEnd(few, {}).along_m, 0.3);
}

TEST(FindWallEnd, IsWithinThreeSigmasUnderNoiseNearlyAlways) {
  int within = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Rng rng(seed);
    const double line_m = rng.Uniform(0.4, 2), beyond_m = line_m * rng.Uniform(0, 0.25);
    const WallEnd dut = FindWallEnd(Echoes(line_m, beyond_m, 0, &rng), {});
    within += std::abs(dut.along_m) < 3 * dut.sigma_m + 0.03 ? 1 : 0;
  }
  EXPECT_GE(within, 990);
}

}  // namespace
}  // namespace priamos::robot
