#include "world/core/render/plan_index.hpp"

#include <gmock/gmock.h>

#include <set>

#include "common/random.hpp"

namespace priamos::world {
namespace {

std::multiset<std::size_t> Near(const PlanIndex& index, const Eigen::Vector2d& place, double reach_m) {
  std::multiset<std::size_t> found;
  index.VisitNear(place, reach_m, [&](std::size_t disc) { found.insert(disc); });
  return found;
}

TEST(PlanIndex, FindsAllThatReachAndEachOnce) {
  Rng rng(3);
  std::vector<PlanIndex::Disc> discs(300);
  for (auto& disc : discs)
    disc = {{rng.Uniform(-20, 30), rng.Uniform(5, 40)}, rng.Uniform(0, 1) < 0.1 ? 7 : rng.Uniform(0.05, 2)};
  const PlanIndex dut(discs);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector2d place(rng.Uniform(-40, 50), rng.Uniform(-10, 60));
    const double reach_m = rng.Uniform(0.1, 8);
    const auto found = Near(dut, place, reach_m);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const bool reaches = (discs[i].centre - place).norm() - discs[i].radius_m <= reach_m;
      EXPECT_LE(found.count(i), 1U);
      EXPECT_TRUE(!reaches || found.count(i) == 1) << i;
    }
  }
}

TEST(PlanIndex, LeavesOutMostOfWhatIsFarAway) {
  std::vector<PlanIndex::Disc> discs;
  for (int x = 0; x < 50; ++x)
    for (int y = 0; y < 50; ++y) discs.push_back({{x, y}, 0.1});
  EXPECT_LT(Near(PlanIndex(discs), {25, 25}, 1.2).size(), 150U);
}

TEST(PlanIndex, HasNothingOfNothing) {
  EXPECT_TRUE(Near(PlanIndex(), {0, 0}, 5).empty());
  EXPECT_TRUE(Near(PlanIndex(std::vector<PlanIndex::Disc>{}), {1e12, -1e12}, 5).empty());
  EXPECT_EQ(Near(PlanIndex({{{0, 0}, 9}}), {1e12, 0}, 5).size(), 1U);
}

}  // namespace
}  // namespace priamos::world
