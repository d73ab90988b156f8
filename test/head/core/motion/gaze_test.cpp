#include "head/core/motion/gaze.hpp"

#include <gtest/gtest.h>

#include "test/head/core/motion/aimed_head.hpp"

namespace priamos::head {
namespace {

/// The five edges at (6, 2.4) of the map, faced by a base that stands `before_m` before them.
struct Scene {
  explicit Scene(double before_m, double speed_m_s = 0) {
    door.map_from_landmark = {6, 2.4, 0};
    robot.map_from_base = {6 - before_m, 2.4, 0};
    robot.twist.vx = speed_m_s;
    config.fixed = {0, -0.09, {-0.02, 0.02}, {250, 250}, {1600, 1600}};
  }
  LookWish Wish(int side) const { return {door, robot, side}; }
  HeadSetting Setting(int side, const HeadStanding& standing = {}) const {
    return SettingFor(HeadOfOneLens(), Wish(side), standing, config);
  }

  LandmarkModel door = DoorOfFiveEdges();
  PoseSample robot;
  GazeConfig config;
};

TEST(Gaze, TurnsToTheSideThatIsLookedAt) {
  const Scene dut(1.2);
  EXPECT_GT(dut.Setting(1).pan_rad, 0);
  EXPECT_LT(dut.Setting(2).pan_rad, 0);
  EXPECT_EQ(dut.Setting(1).zoom_step, dut.config.fixed.zoom_step);
}

TEST(Gaze, AHeadThatStandsWellEnoughStays) {
  const Scene dut(1.2);
  HeadSetting beside = dut.Setting(1);
  beside.pan_rad += Radians(2);
  EXPECT_EQ(dut.Setting(1, {.here = beside, .kept = beside}).pan_rad, beside.pan_rad);
  EXPECT_NE(dut.Setting(1, {.here = beside, .kept = {}}).pan_rad, beside.pan_rad);
}

TEST(Gaze, BeyondALandmarkItTurnsToWhereTheMostStands) {
  const Scene dut(0.5);
  const auto pan_to = [&](double y_m) {
    return SettingBeyond(HeadOfOneLens(), dut.Wish(0), {{{3, y_m}, 0.5, 1.8}, {{3, y_m + 0.2}, 0.5, 1.8}},
                         dut.config)
        .pan_rad;
  };
  EXPECT_GT(pan_to(2.5), Radians(5));
  EXPECT_LT(pan_to(-2.5), Radians(-5));
}

TEST(Gaze, AnApproachCountsAlongTheLandmarksAxisFromEitherSide) {
  const Scene before(0.8, 0.3);
  EXPECT_NEAR(DistanceTo(before.Wish(0)), 0.8, 1e-9);
  const Approach ahead = ApproachTo(before.Wish(0), 4);
  EXPECT_NEAR(ahead.ahead_m, 0.8, 1e-9);
  EXPECT_NEAR(ahead.speed_m_s, 0.3, 1e-9);
  EXPECT_TRUE(ahead.sees_beyond);
  EXPECT_FALSE(ApproachTo(before.Wish(0), 3).sees_beyond);
  const Scene behind(-0.2);
  EXPECT_NEAR(ApproachTo(behind.Wish(0), 0).ahead_m, -0.2, 1e-9);
  Scene returning(-0.7);
  returning.robot.map_from_base.yaw = kPi;
  EXPECT_NEAR(ApproachTo(returning.Wish(0), 0).ahead_m, 0.7, 1e-9);
}

}  // namespace
}  // namespace priamos::head
