#include "planner/core/missions/mission_table.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <stdexcept>

#include "drive_ahead_mission.hpp"

namespace priamos::planner {
namespace {

constexpr int kAhead = 9, kOther = 4;
constexpr Duration kStep = std::chrono::milliseconds(50);

/// The frame with two missions, and a robot whose reports are written by hand.
struct Frame {
  Frame() {
    dut.Add(kAhead, std::make_unique<DriveAheadMission>());
    dut.Add(kOther, std::make_unique<DriveAheadMission>());
  }
  MissionActions Step() { return dut.Tick(now += kStep); }
  /// Steps with a robot that goes on sending its pose, and its drive status when `drive` is given.
  MissionActions StepFor(double seconds, std::optional<DriveReport> drive = {}) {
    MissionActions last_sent;
    for (const Time end = now + FromSeconds(seconds); now < end;) {
      Hear();
      if (drive) dut.OnDrive(*drive, now);
      const MissionActions actions = Step();
      if (actions.path) last_sent = actions;
    }
    return last_sent;
  }
  void Hear() { dut.OnPose({now, {2, 1, 0}, {}, Eigen::Matrix3d::Zero()}); }
  /// Starts a mission and answers its look. Returns the path that it orders.
  PathOrder Drive(int kind = kAhead) {
    EXPECT_TRUE(dut.Start(now, {kind, 3}));
    Hear();
    const auto look = Step().look;
    EXPECT_TRUE(look);
    dut.OnLook({look->request_id, true, "", false});
    return Step().path.value_or(PathOrder{});
  }

  Time now = FromUtime(1'000'000'000);
  MissionTable dut;
};

TEST(MissionTable, BeforeTheFirstOrderNothingIsSentAndTheFirstMissionIsShown) {
  Frame f;
  f.Hear();
  const MissionActions actions = f.Step();
  EXPECT_FALSE(actions.model || actions.path || actions.look);
  EXPECT_EQ(f.dut.state(), MissionState{});
  EXPECT_EQ(f.dut.kind(), kAhead);
}

TEST(MissionTable, ATouchThatIsToldWhenTheNextPathIsOnItsWayCounts) {
  Frame f;
  const PathOrder path = f.Drive();
  f.dut.Pause(f.now);
  f.Step();
  f.dut.Resume(f.now);
  f.Hear();
  const auto next = f.Step().path;
  ASSERT_TRUE(next);
  ASSERT_NE(next->path_id, path.path_id);
  DriveReport drive;
  drive.path_id = path.path_id;
  drive.mode = DriveMode::kHolding;
  drive.touched = true;
  f.dut.OnDrive(drive, f.now);
  f.Step();
  EXPECT_EQ(f.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(f.dut.state().text, ::testing::HasSubstr("touched"));
}

TEST(MissionTable, WhoTouchesARobotThatStoodAlreadyEndsNoMission) {
  Frame f;
  DriveReport drive;
  drive.path_id = f.Drive().path_id;
  drive.mode = DriveMode::kArrived;
  f.dut.OnDrive(drive, f.now);
  drive.touched = true;
  for (int i = 0; i < 3; ++i) f.dut.OnDrive(drive, f.now);
  f.Step();
  EXPECT_NE(f.dut.state().phase, Phase::kFailed) << f.dut.state().text;
}

TEST(MissionTable, WhoTouchesARobotAsItArrivesEndsNoMission) {
  Frame f;
  DriveReport drive;
  drive.path_id = f.Drive().path_id;
  drive.mode = DriveMode::kFollowing;
  f.dut.OnDrive(drive, f.now);
  drive.mode = DriveMode::kArrived;
  drive.touched = true;
  f.dut.OnDrive(drive, f.now);
  f.Step();
  EXPECT_NE(f.dut.state().phase, Phase::kFailed) << f.dut.state().text;
}

TEST(MissionTable, ATouchOfAnEarlierMissionDoesNotCount) {
  Frame f;
  const PathOrder path = f.Drive();
  f.dut.Abort("enough");
  f.Step();
  ASSERT_FALSE(f.dut.running());
  f.Drive();
  DriveReport drive;
  drive.path_id = path.path_id;
  drive.touched = true;
  f.dut.OnDrive(drive, f.now);
  f.Step();
  EXPECT_TRUE(f.dut.running());
}

TEST(MissionTable, KnowsWhatWasAddedAndTakesAKindOnce) {
  Frame f;
  EXPECT_TRUE(f.dut.Knows(kOther));
  EXPECT_FALSE(f.dut.Knows(1));
  EXPECT_THROW(f.dut.Add(kOther, std::make_unique<DriveAheadMission>()), std::logic_error);
}

TEST(MissionTable, AMissionSeesWhatWasHeardAndItsOrdersLeaveInTheSameStep) {
  Frame f;
  const PathOrder path = f.Drive(kOther);
  ASSERT_EQ(path.points.size(), 1u);
  EXPECT_DOUBLE_EQ(path.points[0].x, 3);
  EXPECT_DOUBLE_EQ(path.speed_m_s, 0.2);
  EXPECT_EQ(f.dut.kind(), kOther);
  f.dut.OnDrive({DriveMode::kArrived, path.path_id, ""}, f.now);
  f.Step();
  EXPECT_EQ(f.dut.state(), (MissionState{Phase::kDone, "1 m ahead"}));
  EXPECT_FALSE(f.dut.running());
}

TEST(MissionTable, AnAnswerIsHeardInOneStepOnly) {
  Frame f;
  f.dut.Start(f.now, {kAhead, 3});
  f.dut.OnLook({1002, true, "", false});  // Before the look that will carry this number was ordered.
  f.Hear();
  const auto look = f.Step().look;
  ASSERT_TRUE(look);
  ASSERT_EQ(look->request_id, 1002);
  EXPECT_FALSE(f.StepFor(1).path);
  f.dut.OnLook({look->request_id + 1, true, "", false});
  EXPECT_FALSE(f.Step().path);
}

TEST(MissionTable, NumbersGoOnOverTheMissions) {
  Frame f;
  const int first = f.Drive(kAhead).path_id;
  f.dut.Abort();
  const int brake = f.Step().path.value_or(PathOrder{}).path_id;
  const int second = f.Drive(kOther).path_id;
  EXPECT_EQ(brake, first + 1);
  EXPECT_EQ(second, brake + 2);  // A look came between.
}

TEST(MissionTable, NumbersStayInTheRangeOfTheMessages) {
  Frame f;
  f.now = FromUtime(65534LL * 1'000'000);
  EXPECT_EQ(f.Drive().path_id, 2);  // 65535 was the clock's, 1 the look's.
}

TEST(MissionTable, AnEmergencyStopEndsAMissionAndNoneBeginsWhileItIsLatched) {
  Frame f;
  const int path = f.Drive().path_id;
  f.dut.OnDrive({DriveMode::kHolding, path, "emergency stop", true}, f.now);
  const auto brake = f.Step().path;
  ASSERT_TRUE(brake);
  EXPECT_TRUE(brake->points.empty());
  EXPECT_EQ(f.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(f.dut.state().text, testing::HasSubstr("emergency stop"));
  EXPECT_TRUE(f.dut.Start(f.now, {kAhead, 3}));
  const MissionActions actions = f.StepFor(10);
  EXPECT_FALSE(actions.path && !actions.path->points.empty());
  EXPECT_EQ(f.dut.state().phase, Phase::kFailed);
  f.dut.OnDrive({DriveMode::kHolding, path, "", false}, f.now);
  EXPECT_FALSE(f.Drive().points.empty()) << "re-armed";
}

/// The radio may lose every report between a stop and its re-arming.
TEST(MissionTable, AnEmergencyStopThatNobodyReportedEndsTheMissionAllTheSame) {
  Frame f;
  f.dut.OnDrive({.mode = DriveMode::kIdle, .limit = "", .estop_changes = 255}, f.now);
  const PathOrder path = f.Drive();
  EXPECT_EQ(path.estop_changes, 255);
  f.dut.OnDrive({.mode = DriveMode::kHolding, .path_id = path.path_id, .limit = "", .estop_changes = 1},
                f.now);
  const auto brake = f.Step().path;
  ASSERT_TRUE(brake);
  EXPECT_TRUE(brake->points.empty());
  EXPECT_THAT(f.dut.state().text, testing::HasSubstr("since the order"));
  EXPECT_EQ(f.Drive().estop_changes, 1) << "a new order";
}

/// Who ordered could not know of a stop that was reported later.
TEST(MissionTable, AStopBetweenTheLastReportAndTheOrderEndsTheMission) {
  Frame f;
  f.dut.OnDrive({.mode = DriveMode::kIdle, .limit = "", .estop_changes = 7}, f.now);
  EXPECT_TRUE(f.dut.Start(f.now, {kAhead, 3}));
  f.dut.OnDrive({.mode = DriveMode::kIdle, .limit = "", .estop_changes = 9}, f.now);
  f.Step();
  EXPECT_EQ(f.dut.state().phase, Phase::kFailed);
}

TEST(MissionTable, WithoutAReportBeforeTheOrderTheFirstOneAfterItCounts) {
  Frame f;
  EXPECT_TRUE(f.dut.Start(f.now, {kAhead, 3}));
  f.Hear();
  const auto look = f.Step().look;
  ASSERT_TRUE(look);
  f.dut.OnDrive({.mode = DriveMode::kIdle, .limit = "", .estop_changes = 40}, f.now);
  f.dut.OnLook({look->request_id, true, "", false});
  EXPECT_EQ(f.Step().path.value_or(PathOrder{}).estop_changes, 40);
}

TEST(MissionTable, SecondOrderIsRefusedUntilTheFirstMissionIsOver) {
  Frame f;
  f.Drive(kAhead);
  EXPECT_FALSE(f.dut.Start(f.now, {kOther, 3}));
  EXPECT_EQ(f.dut.kind(), kAhead);
  f.dut.Abort();
  f.Step();
  EXPECT_TRUE(f.dut.Start(f.now, {kOther, 3}));
  EXPECT_EQ(f.dut.state(), (MissionState{Phase::kWaiting, "waiting for the robot's pose"}));
}

TEST(MissionTable, OrderThatCannotBeCarriedOutFailsWithoutSendingAnything) {
  Frame f;
  EXPECT_TRUE(f.dut.Start(f.now, {kAhead, 0}));
  EXPECT_EQ(f.dut.state(), (MissionState{Phase::kFailed, "there is no landmark 0"}));
  EXPECT_FALSE(f.Step().path);
}

TEST(MissionTable, FailureIsAReasonAndABrake) {
  Frame f;
  f.dut.Start(f.now, {kAhead, 3});
  f.Hear();
  const auto look = f.Step().look;
  ASSERT_TRUE(look);
  f.dut.OnLook({look->request_id, false, "too few edges", false});
  const auto brake = f.Step().path;
  EXPECT_EQ(f.dut.state(), (MissionState{Phase::kFailed, "nothing seen: too few edges"}));
  ASSERT_TRUE(brake);
  EXPECT_TRUE(brake->points.empty());
  const auto again = f.StepFor(2.5).path;
  ASSERT_TRUE(again) << "the robot has not confirmed it";
  EXPECT_EQ(again->path_id, brake->path_id);
  f.dut.OnDrive({DriveMode::kHolding, brake->path_id, ""}, f.now);
  EXPECT_FALSE(f.StepFor(5).path);
}

TEST(MissionTable, AbortWithoutAMissionDoesNotEndTheNextOne) {
  Frame f;
  f.dut.Abort();
  EXPECT_FALSE(f.Drive().points.empty());
  EXPECT_TRUE(f.dut.running());
}

TEST(MissionTable, UnconfirmedPathIsRepeatedAfterTheMissionsOwnPatience) {
  Frame f;
  const PathOrder path = f.Drive();
  EXPECT_FALSE(f.StepFor(1.9).path);
  const auto repeated = f.StepFor(0.2).path;
  ASSERT_TRUE(repeated);
  EXPECT_EQ(repeated->path_id, path.path_id);
  EXPECT_FALSE(f.StepFor(3, DriveReport{DriveMode::kFollowing, path.path_id, ""}).path);
}

TEST(MissionTable, EveryLimitEndsAMissionWithItsReason) {
  Frame silent;
  silent.Drive();
  for (int i = 0; i < 90; ++i) silent.Step();
  EXPECT_EQ(silent.dut.state().text, "no pose from the robot for 4 s: the radio link is down");

  Frame linked;
  linked.Drive();
  linked.dut.OnLink(true);
  for (int i = 0; i < 90; ++i) linked.Step();
  EXPECT_EQ(linked.dut.state().text,
            "no pose from the robot for 4 s: the radio link is up, is the robot running?");

  Frame slow;
  const DriveReport driving{DriveMode::kFollowing, slow.Drive().path_id, ""};
  slow.StepFor(11, driving);
  EXPECT_EQ(slow.dut.state().text, "not 1 m ahead after 10 s");

  Frame blocked;
  const DriveReport standing{DriveMode::kBlocked, blocked.Drive().path_id, "an echo is too near"};
  blocked.StepFor(4, standing);
  EXPECT_EQ(blocked.dut.state().text, "the robot was blocked for 3 s: an echo is too near");

  Frame held;
  const DriveReport holding{DriveMode::kHolding, held.Drive().path_id, ""};
  held.StepFor(4, holding);
  EXPECT_EQ(held.dut.state().text, "the robot held its place for 3 s");
}

TEST(MissionTable, StandingOnAnotherPathIsNotBeingBlocked) {
  Frame f;
  const int path_id = f.Drive().path_id;
  f.StepFor(4, DriveReport{DriveMode::kBlocked, path_id + 7, ""});
  EXPECT_TRUE(f.dut.running());
}

TEST(MissionTable, PoseThatCameLateDoesNotReplaceANewerOne) {
  Frame f;
  f.dut.Start(f.now, {kAhead, 3});
  f.Hear();
  f.dut.OnPose({f.now - kStep, {50, 1, 0}, {}, Eigen::Matrix3d::Zero()});
  const auto look = f.Step().look;
  ASSERT_TRUE(look);
  f.dut.OnLook({look->request_id, true, "", false});
  const auto path = f.Step().path;
  ASSERT_TRUE(path);
  EXPECT_DOUBLE_EQ(path->points[0].x, 3);
}

}  // namespace
}  // namespace priamos::planner
