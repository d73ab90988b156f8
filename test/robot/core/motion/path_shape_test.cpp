#include "robot/core/motion/path_shape.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

const Path kCorner{.id = 1, .speed_m_s = 0.4, .points = {{2, 0, 0}, {2, 2, 0}}};

Path AnyPath() {
  Path path{.id = 1, .speed_m_s = 0.4, .points = {}};
  const int n = *rc::gen::inRange(1, 9);
  for (int i = 0; i < n; ++i) {
    const auto part = [] { return *rc::gen::inRange(-3000, 3001) / 1000.0; };
    path.points.push_back({part(), part(), part()});
  }
  return path;
}

TEST(PathShape, BeginsAtTheStartAndEndsAtTheLastPoint) {
  EXPECT_TRUE(rc::check([] {
    const Path path = AnyPath();
    const PathShape dut({}, {0.1, 0.2, 0.3}, path);
    const Pose2 first = dut.At(0).pose, last = dut.At(dut.length()).pose, goal = path.points.back();
    RC_ASSERT(std::hypot(first.x - 0.1, first.y - 0.2) < 1e-9);
    RC_ASSERT(std::hypot(last.x - goal.x, last.y - goal.y) < 1e-6);
    RC_ASSERT(std::abs(WrapAngle(last.yaw - goal.yaw)) < 1e-6);
  }));
}

TEST(PathShape, DirectionAndTurnAreTheDerivativesOfThePose) {
  EXPECT_TRUE(rc::check([] {
    const PathShape dut({}, {}, AnyPath());
    constexpr double kStep = 1e-5;
    for (double s = 0; s < dut.length() - kStep; s += 0.05) {
      const auto a = dut.At(s), b = dut.At(s + kStep);
      RC_ASSERT(((b.pose.translation() - a.pose.translation()) / kStep - a.direction).norm() < 1e-2);
      RC_ASSERT(std::abs(WrapAngle(b.pose.yaw - a.pose.yaw) / kStep - a.turn) < 1e-2);
    }
  }));
}

TEST(PathShape, DirectionNeverJumps) {
  EXPECT_TRUE(rc::check([] {
    const PathShape dut({}, {}, AnyPath());
    for (double s = 0; s + 1e-6 < dut.length(); s += 0.01) {
      // Also across a corner: 1 micrometre of way changes the direction by next to nothing.
      RC_ASSERT((dut.At(s + 1e-6).direction - dut.At(s).direction).norm() < 1e-3);
    }
  }));
}

TEST(PathShape, ARoundedCornerPassesWithinTheAllowedDeviation) {
  const PathShape dut({.corner_deviation_m = 0.05}, {}, kCorner);
  double nearest = 10;
  for (double s = 0; s < dut.length(); s += 0.001)
    nearest = std::min(nearest, (dut.At(s).pose.translation() - Eigen::Vector2d(2, 0)).norm());
  EXPECT_NEAR(nearest, 0.05, 1e-3);
}

TEST(PathShape, EveryLimitIsReachedByBrakingNoHarderThanAllowed) {
  EXPECT_TRUE(rc::check([] {
    const PathShape dut({.braking_m_s2 = 0.4}, {}, AnyPath());
    for (double s = 0; s < dut.length(); s += 0.01) {
      const double now = dut.SpeedAt(s), next = dut.SpeedAt(s + 0.01);
      RC_ASSERT(now * now - next * next <= 2 * 0.4 * 0.01 + 1e-9);
      RC_ASSERT(now <= 0.4 + 1e-9);
    }
    RC_ASSERT(dut.SpeedAt(dut.length()) < 1e-9);
  }));
}

TEST(PathShape, SpeedTimesTurnStaysBelowTheTurnLimit) {
  EXPECT_TRUE(rc::check([] {
    const PathShape dut({.max_turn_rad_s = 0.5}, {}, AnyPath());
    for (double s = 0; s < dut.length(); s += 0.01)
      RC_ASSERT(std::abs(dut.SpeedAt(s) * dut.At(s).turn) <= 0.5 + 1e-9);
  }));
}

TEST(PathShape, TheSharperSideOfACornerLimitsTheSpeedOnAllOfIt) {
  const Path turn_slackens{.id = 1, .speed_m_s = 0.4, .points = {{0, 0, 1}, {1, 0, 1.8}}};
  const PathShape dut({.max_turn_rad_s = 0.3}, {}, turn_slackens);
  for (double s = 0; s < dut.length(); s += 0.01) EXPECT_LE(dut.SpeedAt(s) * dut.At(s).turn, 0.3 + 1e-9) << s;
}

TEST(PathShape, AStraightPathIsDrivenAtFullSpeedUntilTheEnd) {
  const PathShape dut({.braking_m_s2 = 0.4}, {},
                      {.id = 1, .speed_m_s = 0.4, .points = {{1, 0, 0}, {2, 0, 0}, {4, 0, 0}}});
  for (double s = 0; s < 3.7; s += 0.05) EXPECT_NEAR(dut.SpeedAt(s), 0.4, 1e-9);
}

TEST(PathShape, ATurnOnTheSpotHasWayToo) {
  const PathShape dut({}, {}, {.id = 1, .speed_m_s = 0.4, .points = {{0, 0, 1}}});
  EXPECT_NEAR(dut.length(), PathShape::kTurnLever, 1e-9);
  EXPECT_NEAR(dut.At(dut.length() / 2).pose.yaw, 0.5, 1e-9);
  EXPECT_EQ(dut.RemainingDistance(0), 0);
}

TEST(PathShape, HeadingTakesTheShorterTurnAcrossPi) {
  const PathShape dut({}, {0, 0, 3.0}, {.id = 1, .speed_m_s = 0.4, .points = {{2, 0, -3.0}}});
  EXPECT_NEAR(std::abs(dut.At(dut.length() / 2).pose.yaw), kPi, 1e-6);
}

TEST(PathShape, ProjectFindsTheFootOfThePerpendicular) {
  const PathShape dut({}, {}, {.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}}});
  EXPECT_NEAR(dut.Project({1.7, 0.2, 0}, 1.5), 1.7, 1e-6);
  EXPECT_NEAR(dut.Project({1.3, -0.2, 0}, 1.5), 1.3, 1e-6);
  EXPECT_EQ(dut.Project({9, 0, 0}, 3.9), 4);
}

TEST(PathShape, ProjectStaysOnItsBranchWhereThePathComesBackBesideItself) {
  const PathShape dut({}, {}, {.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}, {4, 0.3, 0}, {0, 0.3, 0}}});
  EXPECT_LT(dut.Project({2, 0.2, 0}, 1.9), 2.1);
}

TEST(PathShape, PointsOnTopOfEachOtherDoNotStopTheBase) {
  const PathShape dut(
      {}, {}, {.id = 1, .speed_m_s = 0.4, .points = {{1, 0, 0}, {1.001, 0, 0}, {1.002, 0, 0}, {3, 0, 0}}});
  for (double s = 0.1; s < 2.5; s += 0.05) EXPECT_GT(dut.SpeedAt(s), 0.35);
}

}  // namespace
}  // namespace priamos::robot
