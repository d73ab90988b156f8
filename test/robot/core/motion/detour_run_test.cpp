// The controller on a base that slips, with sonars, before things that nobody told it of.

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "test/robot/support/robot_rig.hpp"

namespace priamos::robot {
namespace {

constexpr Leeway kWide{1.8, 1.8};

/// What a drive of 5 m brought.
struct Drive {
  bool arrived = false;
  double seconds = 0, min_gap_m = 9, farthest_aside_m = 0;
};

Drive DriveAlong(std::uint64_t seed, const std::vector<Surface>& things, const Leeway& leeway) {
  RobotRig rig(seed, {}, {}, {}, things);
  rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{5, 0, 0}}, .leeway = {leeway}});
  Drive drive;
  for (int tick = 0; tick < 50 * 60 && !drive.arrived; ++tick) {
    rig.Tick();
    drive.seconds = tick / 50.0;
    drive.farthest_aside_m = std::max(drive.farthest_aside_m, std::abs(rig.base().truth().y));
    drive.arrived = rig.state().mode == DriveMode::kArrived;
  }
  drive.min_gap_m = rig.min_gap();
  return drive;
}

std::vector<Surface> BoxAt(double x, double y, double half) {
  return BoxSides(x - half, y - half, x + half, y + half);
}

TEST(DetourRun, DrivesAroundABoxOnItsPath) {
  const double free_s = DriveAlong(1, {}, kWide).seconds;
  int arrived = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng = Rng::Stream(seed, "boxes");
    const auto box = BoxAt(rng.Uniform(1.6, 3.5), rng.Uniform(-0.5, 0.5), rng.Uniform(0.1, 0.4));
    const Drive drive = DriveAlong(seed, box, kWide);
    arrived += drive.arrived;
    EXPECT_GT(drive.min_gap_m, 0.02) << seed;
    EXPECT_TRUE(!drive.arrived || drive.seconds < 1.6 * free_s) << seed;
  }
  EXPECT_GE(arrived, 19);
}

/// The last bit of a path may not be left: a planner that wants its goal reached orders it so.
TEST(DetourRun, AroundABoxShortlyBeforeItsGoalItArrivesThereAndNotBesideIt) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng = Rng::Stream(seed, "last box");
    RobotRig rig(seed, {}, {}, {}, BoxAt(rng.Uniform(3.2, 3.5), rng.Uniform(-0.2, 0.2), 0.4));
    rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{4.4, 0, 0}, {5, 0, 0}}, .leeway = {kWide, {}}});
    for (int tick = 0; tick < 50 * 60 && rig.state().mode != DriveMode::kArrived; ++tick) rig.Tick();
    EXPECT_EQ(rig.state().mode, DriveMode::kArrived) << seed;
    const Pose2 believed = rig.localiser().estimate()->pose;
    EXPECT_LT((believed.translation() - Eigen::Vector2d(5, 0)).norm(), 0.02) << seed;
  }
}

TEST(DetourRun, WithoutLeewayItStandsBeforeABox) {
  const Drive drive = DriveAlong(2, BoxAt(2.5, 0.1, 0.2), {});
  EXPECT_FALSE(drive.arrived);
  EXPECT_LT(drive.farthest_aside_m, 0.05);
  EXPECT_GT(drive.min_gap_m, 0.02);
}

TEST(DetourRun, StaysOnAFreePath) {
  const Drive drive = DriveAlong(3, BoxAt(2.5, 1.2, 0.2), kWide);
  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.farthest_aside_m, 0.1);
}

TEST(DetourRun, BetweenWallsThatLeaveNoRoomItStands) {
  std::vector<Surface> things = BoxSides(-1, 0.8, 6, 1.0);
  for (const Surface& s : BoxSides(-1, -1.0, 6, -0.8)) things.push_back(s);
  for (const Surface& s : BoxAt(2.5, 0.0, 0.2)) things.push_back(s);
  const Drive drive = DriveAlong(4, things, kWide);
  EXPECT_FALSE(drive.arrived);
  EXPECT_GT(drive.min_gap_m, 0.01);
}

}  // namespace
}  // namespace priamos::robot
