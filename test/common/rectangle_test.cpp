#include "common/rectangle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "common/random.hpp"

namespace priamos {
namespace {

TEST(Rectangle, CornersOfATurnedOne) {
  const Rectangle dut{{1, 2, kPi / 2}, {2, 1}};
  EXPECT_NEAR((dut.Corners()[0] - Eigen::Vector2d(0, 4)).norm(), 0, 1e-12);
}

TEST(Rectangle, PointInsideHasDistanceZero) {
  const Rectangle dut{{1, 2, 0.3}, {2, 1}};
  EXPECT_EQ(Distance(dut, Eigen::Vector2d(1.5, 2.2)), 0);
}

TEST(Rectangle, PointBesideACorner) {
  const Rectangle dut{{0, 0, 0}, {2, 1}};
  EXPECT_NEAR(Distance(dut, Eigen::Vector2d(5, 5)), 5, 1e-12);
}

TEST(Rectangle, ParallelOnes) {
  EXPECT_NEAR(Distance(Rectangle{{0, 0, 0}, {1, 1}}, Rectangle{{2.5, 0.3, 0}, {1, 4}}), 0.5, 1e-12);
}

TEST(Rectangle, CornerAgainstSide) {
  const Rectangle turned{{2, 0, kPi / 4}, {0.5, 0.5}};
  EXPECT_NEAR(Distance(Rectangle{{0, 0, 0}, {1, 1}}, turned), 1 - std::sqrt(0.5), 1e-12);
}

TEST(Rectangle, CrossWithoutACornerInsideOverlaps) {
  EXPECT_EQ(Distance(Rectangle{{0, 0, 0.2}, {3, 0.1}}, Rectangle{{0, 0, 0.2 + kPi / 2}, {3, 0.1}}), 0);
}

/// Smallest distance between densely sampled boundaries: an upper bound that is close to the truth.
double SampledDistance(const Rectangle& a, const Rectangle& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k <= 400; ++k) {
      const Eigen::Vector2d p = a.Corners()[i] + k / 400.0 * (a.Corners()[(i + 1) % 4] - a.Corners()[i]);
      nearest = std::min(nearest, Distance(b, p));
    }
  }
  return nearest;
}

RC_GTEST_PROP(Rectangle, DistanceIsSymmetricAndMatchesSampling, (const unsigned seed)) {
  Rng rng(seed);
  const auto draw = [&rng] {
    return Rectangle{{rng.Uniform(-2, 2), rng.Uniform(-2, 2), rng.Uniform(-4, 4)},
                     {rng.Uniform(0.05, 1), rng.Uniform(0.05, 1)}};
  };
  const Rectangle a = draw(), b = draw();
  const double distance = Distance(a, b);
  RC_ASSERT(std::abs(distance - Distance(b, a)) < 1e-12);
  const bool one_inside =
      Distance(a, b.map_from_centre.translation()) == 0 || Distance(b, a.map_from_centre.translation()) == 0;
  if (!one_inside) RC_ASSERT(std::abs(distance - SampledDistance(a, b)) < 0.006);
}

}  // namespace
}  // namespace priamos
