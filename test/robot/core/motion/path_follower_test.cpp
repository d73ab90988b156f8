#include "robot/core/motion/path_follower.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "robot/core/base/twist_slew.hpp"
#include "test/robot/support/simulated_base.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

/// The follower on a base that slips, with a pose that is right unless a test moves it.
class PathFollowerTest : public testing::Test {
 protected:
  struct Moment {
    Pose2 believed;
    Twist2 twist;
    double acceleration = 0, turn_acceleration = 0;  ///< of the command
    PathFollower::Wanted wanted;

    double speed() const { return std::hypot(twist.vx, twist.vy); }
  };

  Moment Tick() {
    constexpr double kDt = 0.02;
    const Pose2 believed = shift_ * base_.truth();
    const auto wanted = dut_.Step(believed, base_.twist(), 0, kDt);
    const Twist2 before = slew_.commanded();
    const Twist2 now = slew_.Step(wanted.twist, kDt);
    const Eigen::Vector2d same = Pose2{0, 0, -before.wz * kDt} * Eigen::Vector2d(before.vx, before.vy);
    base_.Command(ToWheelSpeeds({}, now), base_.now());
    base_.Advance(milliseconds(20));
    return {believed, base_.twist(), (Eigen::Vector2d(now.vx, now.vy) - same).norm() / kDt,
            std::abs(now.wz - before.wz) / kDt, wanted};
  }
  std::vector<Moment> Drive(double seconds) {
    std::vector<Moment> moments;
    for (int i = 0; i < seconds * 50; ++i) moments.push_back(Tick());
    return moments;
  }
  /// Until arrived and at rest, at most 60 s.
  std::vector<Moment> DriveToTheEnd() {
    std::vector<Moment> moments;
    do {
      moments.push_back(Tick());
    } while (moments.size() < 3000 && !(moments.back().wanted.arrived && moments.back().speed() < 1e-3));
    return moments;
  }

  SimulatedBase base_{3, {0, 0, 0}};
  Pose2 shift_;
  TwistSlew slew_{{.acceleration_m_s2 = 0.5, .turn_acceleration_rad_s2 = 1.0}};
  PathFollower dut_{PathFollowerConfig{}};
};

TEST_F(PathFollowerTest, WantsToStandWithoutAPath) {
  const auto wanted = dut_.Step({1, 2, 3}, {0.3, 0, 0}, 0, 0.02);
  EXPECT_EQ(wanted.twist.vx, 0);
  EXPECT_FALSE(wanted.arrived);
}

TEST_F(PathFollowerTest, KeepsWithinOneCentimetreAndThreeTenthsOfADegree) {
  dut_.Follow({.id = 1, .speed_m_s = 0.5, .points = {{2, 0, 0}, {5, 0, 0}}}, {0, 0.15, 0.05});
  for (const Moment& moment : DriveToTheEnd()) {
    if (moment.believed.x < 2.5) continue;
    EXPECT_LT(std::abs(moment.wanted.cross_track_m), 0.01);
    EXPECT_LT(std::abs(moment.wanted.heading_error_rad), Radians(0.3));
  }
  EXPECT_NEAR(base_.truth().x, 5, 0.01);
  EXPECT_NEAR(base_.truth().y, 0, 0.01);
  EXPECT_NEAR(base_.truth().yaw, 0, Radians(0.3));
}

TEST_F(PathFollowerTest, KeepsItsSpeedBetweenStartAndLastPoint) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{1, 0.05, 0}, {2, 0, 0}, {4, 0, 0}}}, {0, 0, 0});
  for (const Moment& moment : DriveToTheEnd()) {
    if (moment.believed.x < 0.4 || moment.believed.x > 3.6) continue;
    EXPECT_GT(moment.speed(), 0.36);
    EXPECT_LT(moment.speed(), 0.44);
  }
}

TEST_F(PathFollowerTest, ACorrectedPoseCausesNoJerkAndNoStop) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}}}, {0, 0, 0});
  Drive(3);
  shift_ = Pose2{0.05, 0.2, Radians(5)};
  const auto moments = DriveToTheEnd();
  for (const Moment& moment : moments) {
    EXPECT_LT(moment.acceleration, 0.5 + 1e-6);
    EXPECT_LT(moment.turn_acceleration, 1.0 + 1e-6);
    if (moment.wanted.remaining_m > 0.5) {
      EXPECT_GT(moment.speed(), 0.3);
    }
  }
  const auto settled = std::find_if(moments.begin(), moments.end(), [](const Moment& moment) {
    return std::abs(moment.wanted.cross_track_m) < 0.01;
  });
  ASSERT_NE(settled, moments.end());
  EXPECT_LT(settled - moments.begin(), 4 * 50) << "the path is met again within 4 s";
  EXPECT_NEAR(moments.back().believed.x, 4, 0.01);
  EXPECT_NEAR(moments.back().believed.y, 0, 0.01);
  EXPECT_NEAR(moments.back().believed.yaw, 0, Radians(0.3));
}

TEST_F(PathFollowerTest, ACorrectionAlongThePathMovesTheReferenceInsteadOfTheBase) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}}}, {0, 0, 0});
  Drive(4);
  shift_ = Pose2{-0.2, 0, 0};
  for (const Moment& moment : Drive(2)) EXPECT_GT(moment.twist.vx, 0.35);
}

TEST_F(PathFollowerTest, RoundsACornerWithoutStopping) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{2, 0, 0}, {2, 2, 0}}}, {0, 0, 0});
  double slowest = 1, farthest = 0;
  for (const Moment& moment : DriveToTheEnd()) {
    if (moment.believed.x > 1 && moment.believed.y < 1) slowest = std::min(slowest, moment.speed());
    farthest = std::max(farthest, std::abs(moment.wanted.cross_track_m));
  }
  EXPECT_GT(slowest, 0.15);
  EXPECT_LT(farthest, 0.02);
  EXPECT_NEAR(base_.truth().y, 2, 0.01);
}

TEST_F(PathFollowerTest, TurnsOnTheSpot) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{0, 0, 1.5}}}, {0, 0, 0});
  for (const Moment& moment : DriveToTheEnd()) EXPECT_LT(moment.believed.translation().norm(), 0.02);
  EXPECT_NEAR(base_.truth().yaw, 1.5, Radians(0.3));
}

TEST_F(PathFollowerTest, DrivesSidewaysWhileTurning) {
  dut_.Follow({.id = 1, .speed_m_s = 0.3, .points = {{0, 3, 1.2}}}, {0, 0, 0});
  double farthest = 0;
  for (const Moment& moment : DriveToTheEnd())
    farthest = std::max(farthest, std::abs(moment.wanted.cross_track_m));
  EXPECT_LT(farthest, 0.02);
  EXPECT_NEAR(base_.truth().y, 3, 0.01);
  EXPECT_NEAR(base_.truth().yaw, 1.2, Radians(0.3));
}

TEST_F(PathFollowerTest, GoesBackWhereThePathTurnsBack) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{2, 0, 0}, {0.5, 0, 0}}}, {0, 0, 0});
  double farthest = 0;
  for (const Moment& moment : DriveToTheEnd()) farthest = std::max(farthest, moment.believed.x);
  EXPECT_GT(farthest, 1.9);
  EXPECT_LT(farthest, 2.05);
  EXPECT_NEAR(base_.truth().x, 0.5, 0.01);
}

TEST_F(PathFollowerTest, ANewPathWhileDrivingCostsNoSpeed) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}}}, {0, 0, 0});
  Drive(3);
  dut_.Follow({.id = 2, .speed_m_s = 0.4, .points = {{2.5, 0.1, 0}, {4, 0.1, 0}}}, base_.truth());
  for (const Moment& moment : Drive(3)) EXPECT_GT(moment.speed(), 0.35);
}

TEST_F(PathFollowerTest, DoesNotGoBackToAFirstPointThatItHasJustPassed) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}}}, {0, 0, 0});
  Drive(3);
  const double x = base_.truth().x;
  dut_.Follow({.id = 2, .speed_m_s = 0.4, .points = {{x - 0.1, 0.05, 0}, {4, 0.05, 0}}}, base_.truth());
  for (const Moment& moment : Drive(2)) EXPECT_GT(moment.twist.vx, 0.3);
  Drive(2);
  EXPECT_NEAR(base_.truth().y, 0.05, 0.01) << "keeps to the line of the path";
}

TEST_F(PathFollowerTest, GoesBackWhenThePathSaysSo) {
  dut_.Follow({.id = 1, .speed_m_s = 0.3, .points = {{-1, 0, 0}, {1, 0, 0}}}, {0, 0, 0});
  double farthest = 0;
  for (const Moment& moment : DriveToTheEnd()) farthest = std::min(farthest, moment.believed.x);
  EXPECT_LT(farthest, -0.9);
}

TEST_F(PathFollowerTest, StaysArrivedWhateverCorrectionsCome) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{1, 0, 0}}}, {0, 0, 0});
  DriveToTheEnd();
  shift_ = Pose2{0.1, 0.1, 0.05};
  for (const Moment& moment : Drive(1)) EXPECT_LT(moment.speed(), 1e-2);
}

TEST_F(PathFollowerTest, CrossTrackIsPositiveLeftOfThePath) {
  dut_.Follow({.id = 1, .speed_m_s = 0.4, .points = {{4, 0, 0}}}, {0, 0, 0});
  EXPECT_NEAR(dut_.Step({1, 0.1, 0}, {}, 0, 0.02).cross_track_m, 0.1, 1e-9);
}

}  // namespace
}  // namespace priamos::robot
