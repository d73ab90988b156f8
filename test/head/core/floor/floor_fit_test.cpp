#include "head/core/floor/floor_fit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector3d;
using support::Between;

const Eigen::Matrix3d kPrior = Vector3d(0.005 * 0.005, 0.01 * 0.01, 0.01 * 0.01).asDiagonal();
constexpr double kVariance = 0.001 * 0.001;

/// The laser's line across a floor 1.5 m ahead: 300 points from 1 m left to 1 m right.
std::vector<LightPoint> Line(const Vector3d& plane, double noise_m = 0, std::uint64_t seed = 1) {
  Rng rng(seed);
  std::vector<LightPoint> points;
  for (int i = 0; i < 300; ++i) {
    Vector3d at(1.5 + 0.1 * std::sin(0.02 * i), 1 - i / 150.0, 0);
    at.z() = plane.dot(FloorPlane::Row(at)) + rng.Normal(noise_m);
    points.push_back({double(i), at, kVariance});
  }
  return points;
}

void Raise(std::vector<LightPoint>& points, int first, int last, double height_m) {
  for (int i = first; i <= last; ++i) points[i].at.z() += height_m;
}

/// What generalised least squares of all points with the prior gives: an independent sum.
FloorPlane Weighted(const std::vector<LightPoint>& points) {
  Eigen::Matrix3d information = kPrior.inverse();
  Vector3d right = Vector3d::Zero();
  for (const LightPoint& p : points) {
    const Vector3d row(1, p.at.x(), p.at.y());
    information += row * row.transpose() / (kColumnsPerFact * p.variance);
    right += row * p.at.z() / (kColumnsPerFact * p.variance);
  }
  return {information.inverse() * right, information.inverse()};
}

RC_GTEST_PROP(FloorFitTest, WithoutObstaclesItIsTheWeightedFitOfAllPoints, ()) {
  const Vector3d plane(Between(-0.006, 0.006), Between(-0.012, 0.012), Between(-0.012, 0.012));
  const auto points = Line(plane);
  const FloorPlane dut = FitFloor(points, kPrior), expected = Weighted(points);
  RC_ASSERT((dut.plane - expected.plane).norm() < 1e-9);
  RC_ASSERT((dut.covariance - expected.covariance).norm() < 1e-9 * expected.covariance.norm());
  for (const LightPoint& p : points) RC_ASSERT(std::abs(dut.HeightOf(p.at)) < 0.0005);
}

TEST(FloorFitTest, WithoutPointsItIsThePrior) {
  const FloorPlane dut = FitFloor({}, kPrior);
  EXPECT_EQ(dut.plane, Vector3d::Zero());
  EXPECT_LT((dut.covariance - kPrior).norm(), 1e-12);
}

TEST(FloorFitTest, OnePointMovesThePriorByItsGain) {
  const LightPoint point{0, {1.5, 0, 0.004}, kVariance};
  const FloorPlane dut = FitFloor(std::vector{point}, kPrior);
  const double before = Vector3d(1, 1.5, 0).dot(kPrior * Vector3d(1, 1.5, 0));
  EXPECT_NEAR(dut.HeightOf(point.at), 0.004 * (1 - before / (before + kColumnsPerFact * kVariance)), 1e-9);
}

RC_GTEST_PROP(FloorFitTest, WhatStandsOnTheFloorDoesNotDrawIt, ()) {
  const Vector3d plane(Between(-0.005, 0.005), Between(-0.01, 0.01), Between(-0.01, 0.01));
  auto points = Line(plane, 0.0005, *rc::gen::inRange(0, 1000));
  const int first = *rc::gen::inRange(0, 200);
  Raise(points, first, first + 90, Between(0.03, 0.5) * (*rc::gen::arbitrary<bool>() ? 1 : -1));
  const FloorPlane dut = FitFloor(points, kPrior);
  for (const double y : {-1.0, 0.0, 1.0}) {
    const Vector3d at(1.5, y, plane.dot(Vector3d(1, 1.5, y)));
    RC_ASSERT(std::abs(dut.HeightOf(at)) < 0.002);
  }
}

TEST(FloorFitTest, MostPointsDecideWhatTheFloorIs) {
  auto points = Line(Vector3d::Zero());
  Raise(points, 0, 119, 0.02);  // either could be the floor
  EXPECT_NEAR(FitFloor(points, kPrior).HeightOf({1.5, -0.5, 0}), 0, 0.002);
  Raise(points, 120, 299, 0.02);
  Raise(points, 0, 119, -0.02);
  EXPECT_NEAR(FitFloor(points, kPrior).HeightOf({1.5, -0.5, 0.02}), 0, 0.002);
}

TEST(FloorFitTest, NoFloorIsFartherFromThePriorThanThatAllows) {
  auto points = Line(Vector3d::Zero());
  Raise(points, 0, 299, 0.3);  // nothing but a box in view
  const FloorPlane dut = FitFloor(points, kPrior);
  EXPECT_LT(dut.plane.norm(), 1e-9);
  EXPECT_LT((dut.covariance - kPrior).norm(), 1e-9) << "nothing was learned";
}

TEST(FloorFitTest, ASingleOutlierInABlockIsNotItsHeight) {
  auto points = Line({0.003, 0, 0});
  for (std::size_t i = 0; i < points.size(); i += 10) points[i].at.z() += i % 20 == 0 ? 0.2 : -0.2;
  EXPECT_NEAR(FitFloor(points, kPrior).HeightOf({1.5, 0, 0.003}), 0, 0.0005);
}

TEST(FloorFitTest, LeftAndRightMayChangePlaces) {
  auto points = Line({0.002, 0.003, 0.006}, 0.0005);
  const Vector3d there = FitFloor(points, kPrior).plane;
  std::reverse(points.begin(), points.end());
  EXPECT_LT((FitFloor(points, kPrior).plane - there).norm(), 1e-6);
  for (LightPoint& p : points) p.at.y() = -p.at.y();
  const Vector3d mirrored = FitFloor(points, kPrior).plane;
  EXPECT_LT((mirrored - Vector3d(there.x(), there.y(), -there.z())).norm(), 1e-6);
}

TEST(FloorFitTest, ErrorsAreWhatTheCovarianceSays) {
  // Points with independent noise of their variance are worth kColumnsPerFact times less than they could be.
  double nees = 0;
  constexpr int kRuns = 100;
  Rng rng(5);
  for (int run = 0; run < kRuns; ++run) {
    const Vector3d truth(rng.Normal(0.005), rng.Normal(0.01), rng.Normal(0.01));
    auto points = Line(truth);
    for (std::size_t i = 0; i < points.size(); i += 5) {
      const double noise = rng.Normal(0.001);  // the same for five columns
      for (std::size_t k = i; k < i + 5; ++k) points[k].at.z() += noise;
    }
    const FloorPlane dut = FitFloor(points, kPrior);
    const Vector3d error = dut.plane - truth;
    nees += error.dot(dut.covariance.inverse() * error) / kRuns;
  }
  EXPECT_NEAR(nees, 3, 1.2);
}

TEST(FloorPlaneTest, HeightIsThatAboveThePlane) {
  const FloorPlane dut{{0.01, 0.02, -0.03}, kPrior};
  EXPECT_DOUBLE_EQ(dut.HeightOf({2, 1, 0.5}), 0.5 - (0.01 + 0.04 - 0.03));
  EXPECT_DOUBLE_EQ(FloorPlane{}.HeightOf({2, 1, 0.5}), 0.5);
}

TEST(FloorPlaneTest, ItsVarianceGrowsWithTheDistance) {
  const FloorPlane dut{Vector3d::Zero(), kPrior};
  EXPECT_NEAR(dut.VarianceAt({0, 0, 0}), 0.005 * 0.005, 1e-12);
  EXPECT_NEAR(dut.VarianceAt({2, 1, 9}), 0.005 * 0.005 + (4 + 1) * 0.01 * 0.01, 1e-12);
}

}  // namespace
}  // namespace priamos::head
