#include "head/core/calibration/targets/same_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/random.hpp"

namespace priamos::head {
namespace {

/// A grid of 4 by 3 points, 20 px apart, from `left_px` on.
std::vector<DiscObservation> Grid(double left_px, double noise_px = 0) {
  Rng rng(7);
  std::vector<DiscObservation> points;
  points.reserve(12);
  for (int i = 0; i < 12; ++i)
    points.push_back(
        {{},
         {left_px + 20 * (i % 4) + rng.Normal(noise_px), 30 + 20 * (i / 4) + rng.Normal(noise_px)},
         0.02});
  return points;
}

TEST(SameViewTest, NoiseMakesNoOtherView) {
  EXPECT_TRUE(ShowSameView(Grid(40), Grid(40)));
  EXPECT_TRUE(ShowSameView(Grid(40), Grid(40, 0.05)));
}

TEST(SameViewTest, WhereCountingBeginsMakesNoOtherView) {
  auto reversed = Grid(40);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_TRUE(ShowSameView(Grid(40), reversed));
}

TEST(SameViewTest, ATargetThatMovedIsAnotherView) {
  EXPECT_FALSE(ShowSameView(Grid(40), Grid(40.6)));
  EXPECT_FALSE(ShowSameView(Grid(40), Grid(60))) << "most points lie on another one";
  auto turned = Grid(40);
  turned.front().centroid_px.x() += 1;
  EXPECT_FALSE(ShowSameView(Grid(40), turned)) << "one point is enough";
}

}  // namespace
}  // namespace priamos::head
