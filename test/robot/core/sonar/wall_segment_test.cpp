#include "robot/core/sonar/wall_segment.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace priamos::robot {
namespace {

/// Echoes of a wall at y = 1.5 + slope * x, by a sensor that drives along x.
std::vector<PlacedEcho> Echoes(double from_m, double to_m, double slope_rad = 0) {
  std::vector<PlacedEcho> echoes;
  const Eigen::Vector2d normal(-std::sin(slope_rad), std::cos(slope_rad));
  for (double x = from_m; x < to_m; x += 0.03)
    echoes.push_back({{x, 0, 0}, {x, 0.39, kPi / 2}, 1.5 - normal.dot(Eigen::Vector2d(x, 0.39)), x});
  return echoes;
}

WallSegment Segment(double from_m, double to_m) {
  const auto echoes = Echoes(from_m, to_m);
  return {{}, {}, echoes, FitSegment(echoes, kPi / 2, {}, {}).value()};
}

RC_GTEST_PROP(FitSegment, FindsTheLineFromARoughAngle, ()) {
  const double slope = Radians(*rc::gen::inRange(-100, 101) / 10.0);
  const auto dut =
      FitSegment(Echoes(-1, 1, slope), kPi / 2 + slope + Radians(*rc::gen::inRange(-10, 11)), {}, {});
  RC_ASSERT(dut.has_value());
  RC_ASSERT(std::abs(WrapAngle(dut->angle_rad - kPi / 2 - slope)) < 1e-6);
  RC_ASSERT(std::abs(dut->distance_m - (1.5 - dut->normal().dot(dut->anchor))) < 1e-6);
}

TEST(FitSegment, LongerIsSurerUntilTheOdometryBendsIt) {
  const auto sigma = [](double length_m) {
    return std::sqrt(FitSegment(Echoes(0, length_m), kPi / 2, {}, {})->covariance(0, 0));
  };
  EXPECT_LT(sigma(1.5), 0.8 * sigma(0.6));
  EXPECT_GT(sigma(8), sigma(1.5)) << "seen from where the base is by then";
}

TEST(FitSegment, WhatTellsNoLineIsRefused) {
  EXPECT_FALSE(FitSegment({}, 0, {}, {}));
  EXPECT_FALSE(FitSegment(Echoes(0, 0.05), kPi / 2, {}, {})) << "two echoes";
  EXPECT_FALSE(FitSegment(std::vector<PlacedEcho>(30, Echoes(0, 0.02)[0]), kPi / 2, {}, {})) << "one place";
  EXPECT_FALSE(FitSegment(Echoes(0, 1), kPi / 2 + Radians(40), {}, {})) << "another line";
  auto damaged = Echoes(0, 1);
  damaged[5].range_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(FitSegment(damaged, kPi / 2, {}, {}));
}

TEST(WallSegment, LiesWhereItsEchoesAre) {
  const WallSegment dut = Segment(0, 1);
  EXPECT_NEAR(dut.length_m(), 0.99, 0.01);
  EXPECT_NEAR(dut.from().y(), 1.5, 1e-6);
  EXPECT_NEAR(dut.from().x(), 0.99, 0.01) << "to the right of who faces the wall";
  EXPECT_NEAR(dut.to().x(), 0, 1e-6);
}

TEST(WallSegment, TakesWhatFitsAndNothingElse) {
  const WallSegment dut = Segment(0, 1);
  const PlacedEcho good = Echoes(1.1, 1.12)[0];
  EXPECT_TRUE(dut.Takes(good));
  PlacedEcho other = good;
  other.range_m += 0.05;
  EXPECT_FALSE(dut.Takes(other)) << "something else";
  other = good;
  other.odom_from_sonar.yaw -= Radians(30);
  EXPECT_FALSE(dut.Takes(other)) << "it looks elsewhere";
  EXPECT_FALSE(dut.Takes(Echoes(1.6, 1.62)[0])) << "too far beyond its end";
}

TEST(WallSegment, GrowsUntilItIsLongEnough) {
  WallSegment dut = Segment(0, 1);
  for (const PlacedEcho& echo : Echoes(1, 8)) EXPECT_TRUE(!dut.Takes(echo) || dut.Add({echo}));
  EXPECT_NEAR(dut.length_m(), 4, 0.05);
}

TEST(WallSegment, StopsWhereTheWallIsStraightNoLonger) {
  WallSegment dut = Segment(0, 1);
  const double length_m = dut.length_m();
  auto crooked = Echoes(1, 1.4);
  for (std::size_t i = 0; i < crooked.size(); ++i) crooked[i].range_m += i % 2 == 0 ? 0.04 : -0.04;
  EXPECT_FALSE(dut.Add(crooked));
  EXPECT_FALSE(dut.grows());
  EXPECT_EQ(dut.length_m(), length_m);
  EXPECT_FALSE(dut.Takes(Echoes(1.1, 1.12)[0]));
}

}  // namespace
}  // namespace priamos::robot
