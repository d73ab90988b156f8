#include "cli/floor/floor_tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace priamos::cli {
namespace {

using Apart = std::vector<std::vector<double>>;

Apart Between(const std::vector<Eigen::Vector2d>& places) {
  Apart apart_m;
  for (const auto& a : places) {
    apart_m.emplace_back();
    for (const auto& b : places) apart_m.back().push_back((a - b).norm());
  }
  return apart_m;
}

TEST(FloorTour, TheOrderIsTheBestOfAllWhereAllCanBeTried) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0, 10);
  for (int n = 0; n < 20; ++n) {
    std::vector<Eigen::Vector2d> places(7);
    for (auto& place : places) place = {anywhere(random), anywhere(random)};
    const Apart apart_m = Between(places);
    std::vector<int> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    double best_m = 1e9;
    do best_m = std::min(best_m, LengthOf(order, apart_m));
    while (std::next_permutation(order.begin() + 1, order.end()));
    const auto found = ShortestOrder(apart_m, 20);
    EXPECT_EQ(found.front(), 0);
    EXPECT_NEAR(LengthOf(found, apart_m), best_m, 1e-6);
  }
}

world::Solid Box(double x_m, double y_m, double length_m, double width_m) {
  world::Solid solid;
  solid.map_from_solid = {x_m, y_m, 0};
  solid.size_m = {length_m, width_m};
  solid.z_max_m = 2.5;
  return solid;
}

TEST(FloorTour, ACorridorIsSeenByDrivingAlongIt) {
  TrueWorld world;
  world.solids = {Box(10, -1.05, 20.2, 0.1), Box(10, 1.05, 20.2, 0.1), Box(-0.05, 0, 0.1, 2),
                  Box(20.05, 0, 0.1, 2)};
  TrueFloor floor(world, {1, 0});
  EXPECT_NEAR(floor.reachable_m2(), 19.6 * 1.6, 1) << "a border of up to 0.2 m is left, in cells";
  const FloorTour tour = TourOf(floor, {1, 0});
  EXPECT_GT(tour.length_m, 16) << "from x = 1 to 2 m before the end";
  EXPECT_LT(tour.length_m, 22) << "and a bit back and forth";
  EXPECT_GE(tour.places, 5);
}

TEST(FloorTour, WhoBeginsInTheMiddleGoesToTheNearerEndFirst) {
  const std::vector<Eigen::Vector2d> places{{0, 0}, {-1, 0}, {-2, 0}, {1, 0}, {5, 0}};
  EXPECT_NEAR(LengthOf(ShortestOrder(Between(places), 5), Between(places)), 2 + 7, 1e-9);
}

}  // namespace
}  // namespace priamos::cli
