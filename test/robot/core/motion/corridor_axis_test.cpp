#include "robot/core/motion/corridor_axis.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

const CorridorConfig kConfig;

/// A piece of a wall that runs along x.
WallPiece Along(double from_x, double to_x, double y) {
  return {{from_x, y}, {to_x, y}};
}

CorridorAxis Begun(double y = 0) {
  return {{0, y, 0}};
}

TEST(CorridorAxis, LiesInTheMiddleBetweenTwoWalls) {
  const auto dut = FindAxis({Along(-1, 2, 1.2), Along(2, -1, -0.8)}, {0.5, 0, 0.03}, Begun(), kConfig);
  EXPECT_NEAR(dut.odom_from_axis.x, 0.5, 1e-9) << "beside the base";
  EXPECT_NEAR(dut.odom_from_axis.y, 0.2, 1e-9);
  EXPECT_NEAR(dut.odom_from_axis.yaw, 0, 1e-9);
  EXPECT_NEAR(dut.half_width_m, 1.0, 1e-9);
  EXPECT_NEAR(*dut.left_m, 1.0, 1e-9);
  EXPECT_NEAR(*dut.right_m, 1.0, 1e-9);
}

TEST(CorridorAxis, ThingsBeforeAWallAreNoWall) {
  const auto dut = FindAxis({Along(-2, 0, 1), Along(0.1, 1.2, 0.6), Along(1.3, 2.5, 1), Along(-2, 2, -1)},
                            {0.5, 0, 0}, Begun(), kConfig);
  EXPECT_NEAR(dut.odom_from_axis.y, 0, 1e-9);
  EXPECT_NEAR(dut.half_width_m, 1, 1e-9);
}

TEST(CorridorAxis, TheWallThatWasFollowedOutweighsALittleMoreOfAnother) {
  CorridorAxis last = Begun();
  last.half_width_m = 1;
  const std::vector<WallPiece> pieces{Along(-1, 0, 1), Along(0.1, 1.6, 0.6), Along(-2, 2, -1)};
  EXPECT_NEAR(FindAxis(pieces, {0, 0, 0}, last, kConfig).odom_from_axis.y, 0, 1e-9);
  EXPECT_NEAR(FindAxis(pieces, {0, 0, 0}, Begun(), kConfig).odom_from_axis.y, -0.2, 1e-9);
}

TEST(CorridorAxis, WithOneWallHalfTheWidthThatWasKnownIsKept) {
  CorridorAxis last = Begun();
  last.half_width_m = 1.1;
  const auto dut = FindAxis({Along(-1, 2, 0.9)}, {0, 0, 0}, last, kConfig);
  EXPECT_NEAR(dut.odom_from_axis.y, -0.2, 1e-9);
  EXPECT_FALSE(dut.right_m);
  const auto unknown = FindAxis({Along(-1, 2, 0.9)}, {0, 0.1, 0}, Begun(), kConfig);
  EXPECT_NEAR(unknown.odom_from_axis.y, 0.1, 1e-9) << "where the base is";
  EXPECT_EQ(unknown.half_width_m, 0);
}

TEST(CorridorAxis, WithoutWallsItGoesOnStraight) {
  CorridorAxis last{{0, 0, 0.1}};
  last.half_width_m = 0.9;
  const std::vector<WallPiece> no_walls{{{1, -2}, {1.2, 2}}, Along(8, 12, 1), Along(-1, 1, 4)};
  const auto dut = FindAxis(no_walls, {3, 0.5, 0.2}, last, kConfig);
  EXPECT_NEAR(dut.odom_from_axis.yaw, 0.1, 1e-9);
  EXPECT_NEAR((last.odom_from_axis.Inverse() * dut.odom_from_axis).y, 0, 1e-9);
  EXPECT_EQ(dut.half_width_m, 0.9);
  EXPECT_FALSE(dut.left_m || dut.right_m);
}

RC_GTEST_PROP(CorridorAxis, IsFoundWhereverTheCorridorLeads, (std::uint64_t seed)) {
  Rng rng(seed);
  const Pose2 odom_from_corridor{rng.Uniform(-50, 50), rng.Uniform(-50, 50), rng.Uniform(-3, 3)};
  const double half_m = rng.Uniform(0.8, 1.5);
  std::vector<WallPiece> pieces;
  for (const double y : {half_m, -half_m})
    for (double x = -3.5; x < 2; x += 1.5) {
      if (rng.Chance(0.2)) continue;  // a door
      pieces.push_back({odom_from_corridor * Eigen::Vector2d(x, y + rng.Normal(0.008)),
                        odom_from_corridor * Eigen::Vector2d(x + 1.4, y + rng.Normal(0.008)), 0.01});
    }
  const Pose2 base = odom_from_corridor * Pose2{0, rng.Uniform(-0.3, 0.3), rng.Uniform(-0.15, 0.15)};
  CorridorAxis last{odom_from_corridor * Pose2{-1, rng.Uniform(-0.2, 0.2), rng.Uniform(-0.08, 0.08)}};
  last.half_width_m = half_m;
  const auto dut = FindAxis(pieces, base, last, kConfig);
  RC_PRE(dut.left_m && dut.right_m);
  const Pose2 error = odom_from_corridor.Inverse() * dut.odom_from_axis;
  RC_ASSERT(std::abs(error.y) < 0.04);
  RC_ASSERT(std::abs(error.yaw) < 0.03);
  RC_ASSERT(std::abs(dut.half_width_m - half_m) < 0.04);
}

TEST(AlongAxis, IsWhatIsLeftOfThePathBetweenTheWalls) {
  const Path ordered{
      .id = 7, .speed_m_s = 0.3, .points = {{20, 1, 0.1}}, .leeway = {{1.5, 0.2}}, .centre = true};
  CorridorAxis axis{{1, 2, 0}};
  axis.half_width_m = 1;
  const CentredPath dut = AlongAxis(ordered, axis, {10, 0, kPi / 2}, 4, 0.39, kConfig);
  EXPECT_NEAR(dut.start.x, 8, 1e-9);
  EXPECT_NEAR(dut.start.y, 1, 1e-9);
  ASSERT_EQ(dut.path.points.size(), 1u);
  EXPECT_NEAR(dut.path.points[0].x, 8, 1e-9);
  EXPECT_NEAR(dut.path.points[0].y, 5, 1e-9);
  EXPECT_NEAR(dut.path.points[0].yaw, kPi / 2, 1e-9);
  EXPECT_NEAR(dut.path.leeway[0].left_m, 1 - 0.39 - kConfig.margin_m, 1e-9) << "as far as the wall";
  EXPECT_NEAR(dut.path.leeway[0].right_m, 0.2, 1e-9) << "as far as ordered";
}

TEST(CorridorGuide, ForgetsWallsThatLieFarBehind) {
  CorridorGuide dut(kConfig);
  dut.Note(1, Along(-1, 2, 1));
  dut.Note(2, Along(-1, 2, -1));
  dut.Begin({0, 0.2, 0.05}, 0);
  EXPECT_NEAR(dut.Follow({0, 0.2, 0}).odom_from_axis.y, 0, 1e-9);
  dut.Follow({30, 0, 0});
  EXPECT_FALSE(dut.Follow({0, 0, 0}).left_m);
}

}  // namespace
}  // namespace priamos::robot
