#include "robot/core/sonar/wall_fit.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

using Range = std::function<double(const Pose2& base_from_sonar)>;

/// What a sensor on the left side measures on its way of `length_m`, in steps of 3 cm; newest last.
std::vector<RangeAt> Series(double length_m, double course_rad, const Range& range, double noise_m = 0,
                            int seed = 1) {
  Rng rng(static_cast<std::uint64_t>(seed));
  std::vector<RangeAt> series;
  for (double travel = -length_m; travel < 1e-9; travel += 0.03) {
    const Pose2 sonar{travel * std::cos(course_rad), 0.39 + travel * std::sin(course_rad), kPi / 2};
    series.push_back({sonar, range(sonar) + (noise_m > 0 ? rng.Normal(noise_m) : 0)});
  }
  return series;
}

/// The perpendicular distance of a wall, as a smooth one answers.
Range Wall(double bearing_rad, double distance_m) {
  return [=](const Pose2& sonar) {
    return distance_m -
           Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad)).dot(sonar.translation());
  };
}

Range Edge(const Eigen::Vector2d& at) {
  return [=](const Pose2& sonar) { return (at - sonar.translation()).norm(); };
}

RC_GTEST_PROP(FitWall, FindsAngleAndDistanceWhateverTheCourse, ()) {
  const double off_axis = Radians(*rc::gen::inRange(-140, 141) / 10.0);
  const double course = Radians(*rc::gen::inRange(-150, 151) / 10.0);
  const double distance = *rc::gen::inRange(8, 40) / 10.0;
  const auto dut = FitWall(Series(1.2, course, Wall(kPi / 2 + off_axis, distance)), {});
  RC_ASSERT(dut.has_value());
  RC_ASSERT(std::abs(dut->bearing_rad - kPi / 2 - off_axis) < 2e-3);
  RC_ASSERT(std::abs(dut->distance_m - distance) < 2e-3);
}

RC_GTEST_PROP(FitWall, AnEdgeOrACornerIsNoWall, ()) {
  const Eigen::Vector2d at(*rc::gen::inRange(-100, 31) / 100.0, *rc::gen::inRange(90, 300) / 100.0);
  const int seed = *rc::gen::inRange(0, 10000);
  RC_ASSERT(!FitWall(Series(0.9, 0, Edge(at), 0.007, seed), {}).has_value());
}

TEST(FitWall, StepsAndFewRangesAreNoWall) {
  const auto step = [](const Pose2& sonar) { return sonar.x < -0.5 ? 2.0 : 1.9; };
  EXPECT_FALSE(FitWall(Series(1.0, 0, step), {}));
  EXPECT_FALSE(FitWall(Series(0.27, 0, Wall(kPi / 2, 2)), {}));
  EXPECT_FALSE(FitWall({}, {}));
}

/// What stands along a room and is no wall: books, chairs, a column, a bay.
TEST(FitWall, RowsOfStepsAndRoundThingsAreNoWall) {
  const auto stairs = [](const Pose2& sonar) { return 1.5 + 0.03 * std::floor(sonar.x / 0.2); };
  const auto column = [](const Pose2& sonar) {
    return (sonar.translation() - Eigen::Vector2d(-0.4, 4.4)).norm() - 3;
  };
  const auto bay = [](const Pose2& sonar) {
    return 3 - (sonar.translation() - Eigen::Vector2d(-0.4, -1.6)).norm();
  };
  const auto with_end = [](const Pose2& sonar) { return 1.2 + (sonar.x > -0.35 ? 0.05 : 0); };
  int taken_for_a_wall = 0;
  for (int seed = 0; seed < 50; ++seed) {
    taken_for_a_wall += FitWall(Series(0.9, 0, stairs, 0.005, seed), {}).has_value();
    EXPECT_FALSE(FitWall(Series(0.9, 0, column, 0.005, seed), {})) << seed;
    EXPECT_FALSE(FitWall(Series(0.9, 0, bay, 0.005, seed), {})) << seed;
    EXPECT_FALSE(FitWall(Series(0.9, 0, with_end, 0.005, seed), {})) << seed;
  }
  EXPECT_LE(taken_for_a_wall, 6) << "steps of 3 cm every 20 cm hide in the noise at times";
}

TEST(FitWall, AWallBesideTheBeamIsNotHeardAsOne) {
  EXPECT_FALSE(FitWall(Series(1.2, 0, Wall(kPi / 2 + Radians(20), 2)), {}));
}

TEST(FitWall, NumbersOutOfRangeAreNoWall) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), 1e200, -1.0})
    EXPECT_FALSE(FitWall(Series(1.0, 0, [&](const Pose2&) { return value; }), {})) << value;
  // Always the same place: the distance along the wall says nothing.
  EXPECT_FALSE(FitWall(std::vector<RangeAt>(40, {{0, 0.39, kPi / 2}, 1.5}), {}));
}

TEST(FitWall, TheCovarianceIsHonest) {
  WallFitConfig config;
  config.drift_deg = 0;
  const double bearing = kPi / 2 + Radians(4), distance = 2;
  double nees = 0;
  int found = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const auto dut = FitWall(Series(1.0, 0, Wall(bearing, distance), config.SigmaOf(1.6), seed), config);
    if (!dut) continue;
    ++found;
    const Eigen::Vector2d error(dut->bearing_rad - bearing, dut->distance_m - distance);
    nees += error.dot(dut->covariance.inverse() * error);
  }
  EXPECT_GT(found, 270);
  EXPECT_NEAR(nees / found, 2, 0.35);
}

}  // namespace
}  // namespace priamos::robot
