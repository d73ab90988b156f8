#include "planner/core/missions/locate_mission.hpp"

#include <gmock/gmock.h>

#include <map>
#include <utility>

#include "fake_robot.hpp"
#include "test/planner/core/locate/simulated_drive.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using testing::HasSubstr;

constexpr int kKind = 5;

/// The shipped rooms, a robot that was carried into them, its ears, and the mission.
struct Kidnapped {
  explicit Kidnapped(const Pose2& truth) : ears(ShippedPlan(), {}, truth, rng), robot(missions, truth) {
    missions.Add(kKind, std::make_unique<LocateMission>(LocateMissionConfig{}, RoutePlannerConfig{},
                                                        Footprint{}, ShippedPlan()));
    robot.error = truth.Inverse() * Pose2{2, 2.4, 0};
    robot.map_from_door = {1000, 0, 0};  // it notices no opening
    robot.answer = [this](const LookOrder& look, int) {
      const bool sees = Sees(look.landmark_id);
      return LookResult{look.request_id, sees, sees ? "" : "too few edges", false};
    };
  }

  /// Whether the base truly stands before that door, and believes it.
  bool Sees(int id) const {
    const Pose2 door = id == 1 ? Pose2{6, 2.4, 0} : Pose2{6, 2.4, kPi};
    const bool beyond = (robot.truth().x > 6) != (id == 101);
    const Pose2 there = (sides_alike && beyond ? door * Pose2{0, 0, kPi} : door).Inverse() * robot.truth(),
                believed = door.Inverse() * robot.Believed();
    return there.x < -1 && there.x > -4 && std::abs(there.y) < 1.5 && std::abs(believed.x - there.x) < 0.4 &&
           std::abs(believed.y - there.y) < 0.4;
  }

  void Run(double seconds) {
    for (const Time end = robot.now() + FromSeconds(seconds); robot.now() < end; ++ticks) {
      robot.Step();
      if (ticks == 20) missions.Start(robot.now(), {.kind = kKind});
      if (ticks > 20 && !missions.running()) return;
      ears.MoveTo(robot.truth());
      robot.blocked = IsClosed();
      if (ticks % 80 == 0) Tell();
    }
  }
  /// Whether what is next on its path is not free.
  bool IsClosed() const {
    if (robot.paths.empty() || robot.paths.back().points.empty()) return false;
    const Pose2 end = robot.Believed().Inverse() * robot.paths.back().points.back();
    const double way_m = end.translation().norm();
    if (way_m < 0.05) return false;
    return !ears.IsFree(robot.truth() * Pose2{0.1 * end.x / way_m, 0.1 * end.y / way_m, 0});
  }
  /// What has not changed is not told again.
  void Tell() {
    int id = 0;
    for (LearnedWall& wall : ears.Told(robot.Believed() * robot.truth().Inverse())) {
      const LearnedWall before = std::exchange(told[++id], wall);
      if ((before.from() - wall.from()).norm() < 0.05 && (before.to() - wall.to()).norm() < 0.05) continue;
      wall.seen_s = static_cast<double>(ToUtime(robot.now())) * 1e-6;
      missions.OnTold({1, id, wall});
    }
  }

  bool IsRight() const {
    const Pose2 off = robot.truth().Inverse() * robot.Believed();
    return off.translation().norm() < 0.45 && std::abs(off.yaw) < Radians(8);
  }

  bool sides_alike = false;  ///< the head takes either side of a door for the other one
  int ticks = 0;
  std::map<int, LearnedWall> told;
  Rng rng{7};
  MissionTable missions;
  SimulatedDrive ears;
  FakeRobot robot;
};

TEST(LocateMission, AnAbortTakesThePoseBack) {
  Kidnapped dut({3.5, 1.4, 2});
  dut.Run(20);
  dut.missions.Abort();
  dut.Run(0.1);
  EXPECT_EQ(dut.missions.state().phase, Phase::kFailed);
  for (int i = 0; i < 20; ++i) dut.robot.Step();
  EXPECT_GT(dut.robot.places.back().sigma_m, 1);
}

TEST(LocateMission, ItFindsOutWhereItIs) {
  for (const Pose2& truth : {Pose2{4.4, 2.4, 0}, Pose2{3.5, 1.4, 0.3}}) {
    Kidnapped dut(truth);
    dut.Run(600);
    EXPECT_EQ(dut.missions.state().phase, Phase::kDone) << dut.missions.state().text;
    EXPECT_TRUE(dut.IsRight()) << truth.x;
  }
}

TEST(LocateMission, ItEndsAndBelievesNoWrongPlace) {
  for (const Pose2& truth : {Pose2{3.5, 1.4, 0}, Pose2{2.6, 1.4, 0}, Pose2{1.4, 3.4, 0}, Pose2{9.5, 2, 0}}) {
    Kidnapped dut(truth);
    dut.Run(600);
    EXPECT_FALSE(dut.missions.running()) << truth.x;
    EXPECT_TRUE(dut.missions.state().phase != Phase::kDone || dut.IsRight()) << truth.x;
  }
}

TEST(LocateMission, WhereBothSidesOfADoorLookAlikeNoWrongPlaceIsBelieved) {
  for (const Pose2& truth : {Pose2{4.2, 2.4, 0.3}, Pose2{7.8, 2.2, 3}, Pose2{8.2, 3.2, 1}}) {
    Kidnapped dut(truth);
    dut.sides_alike = true;
    dut.Run(600);
    EXPECT_TRUE(dut.missions.state().phase != Phase::kDone || dut.IsRight()) << truth.x;
  }
}

TEST(LocateMission, APlanWithoutWallsIsRefused) {
  LocateMission dut({}, {}, {}, GroundPlan{});
  const auto refusal = dut.Start({});
  ASSERT_TRUE(refusal);
  EXPECT_THAT(refusal->reason, HasSubstr("no walls"));
}

}  // namespace
}  // namespace priamos::planner
