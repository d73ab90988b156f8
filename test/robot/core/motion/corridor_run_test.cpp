// The controller in corridors of which nobody told it: only the walls that it hears lead it.

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "test/robot/support/robot_rig.hpp"

namespace priamos::robot {
namespace {

/// A corridor along x, closed at its end.
std::vector<Surface> Corridor(double half_m, double end_m) {
  return {{{-3, half_m}, {end_m, half_m}},
          {{-3, -half_m}, {end_m, -half_m}},
          {{end_m, -half_m}, {end_m, half_m}}};
}

Path Ahead(double metres, double yaw_rad = 0) {
  return {.id = 1,
          .speed_m_s = 0.3,
          .points = {{metres * std::cos(yaw_rad), metres * std::sin(yaw_rad), yaw_rad}},
          .leeway = {{1.5, 1.5}},
          .centre = true};
}

TEST(CorridorRun, AWrongDirectionIsMadeGoodByTheWalls) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Rng rng = Rng::Stream(seed, "corridor run");
    const double half_m = rng.Uniform(0.8, 1.5);
    const Pose2 truth{0, rng.Uniform(-0.2, 0.2), Radians(rng.Uniform(-6, 6))};
    RobotRig rig(seed, truth, {}, {}, Corridor(half_m, 40));
    rig.finds_walls = true;
    rig.SetPath(Ahead(8));
    rig.Run(24);
    EXPECT_NEAR(rig.base().truth().y, 0, 0.06) << seed;
    EXPECT_NEAR(Degrees(rig.base().truth().yaw), 0, 1.5) << seed;
    EXPECT_GT(rig.min_gap(), 0.1) << seed;
    rig.Run(10);
    EXPECT_EQ(rig.state().mode, DriveMode::kArrived) << seed;
    EXPECT_NEAR(rig.base().truth().x, 8, 0.2) << seed;
  }
}

TEST(CorridorRun, APoseThatNobodyKnowsStopsNobodyBetweenWalls) {
  LocaliserConfig lost;
  lost.estimator.initial.position_error_m = 2;
  lost.estimator.initial.yaw_error_deg = 60;
  for (const bool centre : {true, false}) {
    RobotRig rig(6, {}, lost, {}, Corridor(1, 40));
    rig.finds_walls = true;
    Path path = Ahead(6);
    path.centre = centre;
    rig.SetPath(path);
    rig.Run(25);
    EXPECT_EQ(rig.state().mode == DriveMode::kArrived, centre);
  }
}

TEST(CorridorRun, ABoxOnTheWayIsDrivenAround) {
  auto surfaces = Corridor(1.2, 40);
  const auto box = BoxSides(3, -0.5, 3.4, -0.1);
  surfaces.insert(surfaces.end(), box.begin(), box.end());
  RobotRig rig(7, {}, {}, {}, surfaces);
  rig.finds_walls = true;
  rig.SetPath(Ahead(7));
  rig.Run(40);
  EXPECT_EQ(rig.state().mode, DriveMode::kArrived);
  EXPECT_GT(rig.min_gap(), 0.02);
}

TEST(CorridorRun, ADeadEndStopsIt) {
  RobotRig rig(8, {}, {}, {}, Corridor(1.1, 5));
  rig.finds_walls = true;
  rig.SetPath(Ahead(60));
  rig.Run(40);
  EXPECT_EQ(rig.state().mode, DriveMode::kBlocked);
  EXPECT_NEAR(rig.base().truth().x, 5 - 0.475 - 0.13, 0.06);
  EXPECT_GT(rig.min_gap(), 0.05);
}

}  // namespace
}  // namespace priamos::robot
