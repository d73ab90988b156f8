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
  explicit Drive(std::uint64_t seed, const PointFinderConfig& config = {})
      : rng_(seed), dut_(config, OdometryNoise{}) {}

  std::vector<Vector2d> points;  ///< that echo to all sides
  std::optional<double> wall_y;  ///< a smooth wall along x ...
  double wall_from_x = -100;     ///< ... from here on

  /// From now on the odometry errs as it is believed to, and so does the speed of sound.
  void Err() {
    const SharedErrors shared;
    turn_per_m_ = rng_.Normal(shared.yaw_rad_per_m);
    sound_ = 1 + rng_.Normal(shared.sound_speed);
    walks_ = true;
  }

  void Along(double length_m, double step_m = 0.03) {
    for (double end_m = true_.x + length_m; true_.x < end_m; Move(step_m)) {
      now_ += FromSeconds(0.1);
      const std::vector<PlacedEcho> echoes = Listen();
      for (const FoundPoint* found : dut_.Add(echoes, now_)) {
        this->found[found->number] = *found;
        odom_from_map[found->number] = believed_ * true_.Inverse();
      }
      for (const int number : dut_.SeeThrough(echoes)) gone.insert(number);
    }
  }

  void From(double x_m) { true_.x = believed_.x = x_m; }

  std::map<int, FoundPoint> found;     ///< as they were last
  std::map<int, Pose2> odom_from_map;  ///< at that time
  std::set<int> gone;

 private:
  void Move(double step_m) {
    constexpr double kWalked = 0.8;  // wheels slip for some decimetres in the same sense
    const OdometryNoise noise;
    const double root = walks_ ? std::sqrt(kWalked * step_m) : 0;
    true_ = true_ * Pose2{step_m, 0, 0};
    believed_ = believed_ * Pose2{step_m + root * rng_.Normal(noise.drift_m_per_sqrt_m),
                                  root * rng_.Normal(noise.drift_m_per_sqrt_m),
                                  root * rng_.Normal(noise.yaw_rad_per_sqrt_m) + turn_per_m_ * step_m};
  }

  double FirstEcho(const Pose2& sonar) const {
    double first_m = kSonarMax_m;
    for (const Vector2d& point : points) {
      const Vector2d there = sonar.Inverse() * point;
      if (std::abs(std::atan2(there.y(), there.x())) < Radians(10)) first_m = std::min(first_m, there.norm());
    }
    const bool before_wall = wall_y && sonar.x > wall_from_x;
    if (before_wall && std::abs(WrapAngle(sonar.yaw - kPi / 2)) < Radians(10))
      first_m = std::min(first_m, *wall_y - sonar.y);
    return first_m;
  }

  std::vector<PlacedEcho> Listen() {
    std::vector<PlacedEcho> echoes;
    for (int i = 0; i < kSonars; ++i) {
      const Pose2 base_from_sonar = BaseFromSonar(i, Footprint{}.Size());
      const double first_m = FirstEcho(true_ * base_from_sonar);
      if (first_m < kSonarMax_m)
        echoes.push_back(
            {believed_, believed_ * base_from_sonar, sound_ * first_m + rng_.Normal(0.005), true_.x});
    }
    return echoes;
  }

  Rng rng_;
  PointFinder dut_;
  Pose2 true_, believed_;
  bool walks_ = false;
  double turn_per_m_ = 0, sound_ = 1;
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

/// Normalised estimation error squared per degree of freedom, one sample per drive, seen from the base when
/// the place was heard last; nothing else stands there that could pull its echoes.
TEST(PointFinderTest, TheCovarianceIsHonest) {
  constexpr int kRuns = 200;
  PointFinderConfig config;
  config.fit.pulled_m = 0;
  double squared = 0;
  int found = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    Rng rng(static_cast<std::uint64_t>(100 + seed));
    Drive drive(static_cast<std::uint64_t>(seed), config);
    drive.Err();
    drive.points = {{rng.Uniform(1, 3), rng.Uniform(0.8, 2.5)}};
    drive.Along(rng.Uniform(2, 4));
    if (drive.found.empty()) continue;
    ++found;
    const auto& [number, last] = *drive.found.rbegin();
    const Vector2d error = last.fit.at - drive.odom_from_map.at(number) * drive.points[0];
    squared += error.dot(last.fit.covariance.inverse() * error) / 2;
  }
  EXPECT_GT(found, 0.9 * kRuns);
  EXPECT_LT(squared / found, 1.3);
  EXPECT_GT(squared / found, 0.7);
}

/// What was heard from one side is known across that as badly as the odometry turned meanwhile.
TEST(PointFinderTest, WhatIsHeardFromOneSideIsKnownWorseAcross) {
  PointFinderConfig config;
  config.fit.pulled_m = 0;
  Drive drive(9, config);
  drive.points = {{3, 1.2}};
  drive.Along(2.5);
  ASSERT_THAT(drive.found, SizeIs(1));
  const PointFit& fit = drive.found.at(1).fit;
  const Vector2d towards = (fit.at - Vector2d(2, 0)).normalized(), across(-towards.y(), towards.x());
  const double along_m = std::sqrt(towards.dot(fit.covariance * towards));
  EXPECT_GT(std::sqrt(across.dot(fit.covariance * across)), 1.3 * along_m);
}

/// The end of a wall: its echoes lie on the circle around the edge as far as that can be told apart.
TEST(PointFinderTest, AnEdgeOfAWallIsFoundWhereItIs) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Drive drive(seed);
    drive.points = {{2, 1.2}};
    drive.wall_y = 1.2;
    drive.wall_from_x = 2;
    drive.Along(4);
    for (const auto& [number, found] : drive.found) {
      const Vector2d error = found.fit.at - drive.points[0];
      EXPECT_LT(error.dot(found.fit.covariance.inverse() * error), 16) << seed << ": " << error.transpose();
    }
  }
}

}  // namespace
}  // namespace priamos::robot
