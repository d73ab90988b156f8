#include "robot/core/sonar/point_finder.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "common/random.hpp"
#include "common/sonar_ring.hpp"
#include "robot/core/base/footprint.hpp"

namespace priamos::robot {
namespace {

using Eigen::Vector2d;
using testing::IsEmpty;
using testing::SizeIs;

/// A base that drives along x and hears with all sensors what is in their beams.
class Drive {
 public:
  explicit Drive(std::uint64_t seed, const PointFinderConfig& config = {}) : rng_(seed), dut_(config) {}

  std::vector<Vector2d> points;  ///< that echo to all sides
  std::optional<double> wall_y;  ///< a smooth wall along x

  void Along(double length_m, double step_m = 0.03) {
    for (double end_m = x_ + length_m; x_ < end_m; x_ += step_m) {
      now_ += FromSeconds(0.1);
      const std::vector<PlacedEcho> echoes = Listen({x_, 0, 0});
      for (const FoundPoint* found : dut_.Add(echoes, now_)) this->found[found->number] = *found;
      for (const int number : dut_.SeeThrough(echoes)) gone.insert(number);
    }
  }

  void From(double x_m) { x_ = x_m; }

  std::map<int, FoundPoint> found;  ///< as they were last
  std::set<int> gone;

 private:
  std::vector<PlacedEcho> Listen(const Pose2& base) {
    std::vector<PlacedEcho> echoes;
    for (int i = 0; i < kSonars; ++i) {
      const Pose2 sonar = base * BaseFromSonar(i, Footprint{}.Size());
      double first_m = kSonarMax_m;
      for (const Vector2d& point : points) {
        const Vector2d there = sonar.Inverse() * point;
        if (std::abs(std::atan2(there.y(), there.x())) < Radians(10))
          first_m = std::min(first_m, there.norm());
      }
      if (wall_y && std::abs(WrapAngle(sonar.yaw - kPi / 2)) < Radians(10))
        first_m = std::min(first_m, *wall_y - sonar.y);
      if (first_m < kSonarMax_m) echoes.push_back({base, sonar, first_m + rng_.Normal(0.005), base.x});
    }
    return echoes;
  }

  Rng rng_;
  PointFinder dut_;
  double x_ = 0;
  Time now_ = FromUtime(1'000'000);
};

TEST(PointFinderTest, ACornerIsFoundWhereItIs) {
  Drive drive(1);
  drive.points = {{3, 1.2}};
  drive.Along(2.5);
  ASSERT_THAT(drive.found, SizeIs(1)) << "and keeps its number";
  EXPECT_LT((drive.found.at(1).fit.at - drive.points[0]).norm(), 0.02);
}

TEST(PointFinderTest, TwoCornersAreTwo) {
  Drive drive(2);
  drive.points = {{3, 1.2}, {3, -1.2}};
  drive.Along(2.5);
  EXPECT_THAT(drive.found, SizeIs(2));
}

TEST(PointFinderTest, AWallIsNoPoint) {
  for (const double y : {0.6, 1.0, 2.0, 3.5}) {
    Drive drive(3);
    drive.wall_y = y;
    drive.Along(5);
    EXPECT_THAT(drive.found, IsEmpty()) << y;
  }
}

TEST(PointFinderTest, WhatIsHeardFromOneDirectionOnlyIsNone) {
  Drive drive(4);
  drive.points = {{5.5, 0.1}};
  drive.Along(1);
  EXPECT_THAT(drive.found, IsEmpty());
}

TEST(PointFinderTest, WhatIsSeenThroughHasGone) {
  Drive drive(6);
  drive.points = {{2.0, 1.0}};
  drive.Along(3);
  ASSERT_THAT(drive.found, SizeIs(1));
  EXPECT_THAT(drive.gone, IsEmpty());
  drive.points.clear();
  for (double x = -1; x < 6; x += 0.05) drive.points.emplace_back(x, 2.5);  // what is heard behind
  drive.From(1);
  drive.Along(2);
  EXPECT_TRUE(drive.gone.contains(1));
}

TEST(PointFinderTest, WhatStandsIsNotSeenThrough) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    Drive drive(seed);
    drive.points = {{rng.Uniform(1, 4), rng.Uniform(0.7, 2)}};
    drive.wall_y = 2.5;
    drive.Along(6);
    EXPECT_THAT(drive.gone, IsEmpty()) << seed;
  }
}

TEST(PointFinderTest, SilenceTellsNothing) {
  Drive drive(8);
  drive.points = {{2.0, 1.0}};
  drive.Along(3);
  ASSERT_THAT(drive.found, SizeIs(1));
  drive.points.clear();
  drive.From(1);
  drive.Along(2);
  EXPECT_THAT(drive.gone, IsEmpty());
}

TEST(PointFinderTest, WhatMovesIsNone) {
  Drive drive(5);
  for (int i = 0; i < 60; ++i) {
    drive.points = {{2 + 0.05 * i, 1.5 - 0.02 * i}};
    drive.Along(0.03);
  }
  EXPECT_THAT(drive.found, IsEmpty());
}

/// One sample per drive; two degrees of freedom.
TEST(PointFinderTest, TheCovarianceIsHonest) {
  constexpr int kRuns = 200;
  double squared = 0;
  int found = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    Rng rng(static_cast<std::uint64_t>(100 + seed));
    Drive drive(static_cast<std::uint64_t>(seed));
    drive.points = {{rng.Uniform(1, 3), rng.Uniform(0.8, 2.5)}};
    drive.Along(rng.Uniform(2, 4));
    if (drive.found.empty()) continue;
    ++found;
    const PointFit& fit = drive.found.rbegin()->second.fit;
    const Vector2d error = fit.at - drive.points[0];
    squared += error.dot(fit.covariance.inverse() * error) / 2;
  }
  EXPECT_GT(found, 0.9 * kRuns);
  EXPECT_LT(squared / found, 1.5);
  EXPECT_GT(squared / found, 0.3);
}

}  // namespace
}  // namespace priamos::robot
