#include "planner/core/explore/frontier_tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/random.hpp"

namespace priamos::planner {
namespace {

struct Places {
  std::vector<double> to;
  Eigen::MatrixXd between;
};

/// Places on a line, the base at 0.
Places OnLine(const std::vector<double>& at) {
  Places places{{}, Eigen::MatrixXd(at.size(), at.size())};
  for (std::size_t i = 0; i < at.size(); ++i) {
    places.to.push_back(std::abs(at[i]));
    for (std::size_t k = 0; k < at.size(); ++k)
      places.between(Eigen::Index(i), Eigen::Index(k)) = std::abs(at[i] - at[k]);
  }
  return places;
}

TEST(FrontierTour, OnePlaceIsTheFirst) {
  const Places places = OnLine({3});
  EXPECT_EQ(FirstOfTour(places.to, places.between), 0U);
}

TEST(FrontierTour, WhatWouldHaveToBeComeBackToComesFirst) {
  // The nearest is ahead, and so is much else; one lies behind.
  const Places places = OnLine({3, 6, 9, 12, -4});
  EXPECT_EQ(FirstOfTour(places.to, places.between), 4U);
}

TEST(FrontierTour, WhereNoWayLeadsFromTheOthersDoesNotDecide) {
  Places places = OnLine({5, 1, 2});
  for (Eigen::Index i = 1; i < 3; ++i)
    places.between(0, i) = places.between(i, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(FirstOfTour(places.to, places.between), 1U);
}

/// Property: no order is shorter than one that begins with what it says.
TEST(FrontierTour, NoOrderIsShorter) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng = Rng::Stream(seed, "tour");
    const std::size_t n = 1 + rng.Below(6);
    Places places{{}, Eigen::MatrixXd(n, n)};
    std::vector<Eigen::Vector2d> at;
    for (std::size_t i = 0; i < n; ++i) at.emplace_back(rng.Uniform(-9, 9), rng.Uniform(-9, 9));
    for (std::size_t i = 0; i < n; ++i) {
      places.to.push_back(at[i].norm());
      for (std::size_t k = 0; k < n; ++k)
        places.between(Eigen::Index(i), Eigen::Index(k)) = (at[i] - at[k]).norm();
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0U);
    std::vector<double> best(n, 1e9);
    do {
      double length = at[order[0]].norm();
      for (std::size_t i = 1; i < n; ++i) length += (at[order[i]] - at[order[i - 1]]).norm();
      best[order[0]] = std::min(best[order[0]], length);
    } while (std::next_permutation(order.begin(), order.end()));
    const std::size_t first = FirstOfTour(places.to, places.between);
    EXPECT_NEAR(best[first], *std::min_element(best.begin(), best.end()), 1e-9) << seed;
  }
}

}  // namespace
}  // namespace priamos::planner
