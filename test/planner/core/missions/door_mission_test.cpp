#include "planner/core/missions/door_mission.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "common/random.hpp"
#include "door_mission_story.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

TEST(DoorMission, SendsNothingBeforeTheFirstOrder) {
  DoorStory s;
  s.robot.RunFor(3);
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting);
  EXPECT_TRUE(s.robot.paths.empty());
  EXPECT_EQ(s.robot.models_received, 0);
}

TEST(DoorMission, PassesTheDoor) {
  DoorStory s;
  s.robot.error = {0.05, -0.15, Radians(4)};
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_THAT(s.dut.state().text, HasSubstr("through the door after"));
  EXPECT_NEAR(s.robot.truth().x, 7.5, 0.01);
  EXPECT_NEAR(s.robot.truth().y, 2.4, 0.01);
  EXPECT_EQ(s.robot.paths.size(), 2u);
  EXPECT_EQ(s.robot.models_received, 1);
}

TEST(DoorMission, ItIsNotDoneByThePoseAlone) {
  DoorStory s;
  s.robot.deaf = true;
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text,
            "the robot believes to be behind the door, but its sonars noticed no opening there");
}

TEST(DoorMission, AnOpeningElsewhereOrOfAnEarlierMissionIsNotThisDoor) {
  for (const PassedOpening& other : {PassedOpening{FromUtime(1'020'000'000), {5.0, 2.4, 0}, 0.95},
                                     PassedOpening{FromUtime(999'000'000), {6.05, 2.4, 0}, 0.95}}) {
    DoorStory s;
    s.robot.deaf = true;
    s.Start();
    s.robot.RunUntil(Phase::kPassing);
    s.dut.OnOpening(other);
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, Phase::kFailed) << other.map_from_base.x;
  }
}

RC_GTEST_PROP(DoorMission, LooksWhileDrivingAtAGoodDistanceFromAnyStart, (const unsigned seed)) {
  Rng rng(seed);
  DoorStory s({6 - rng.Uniform(3, 5), 2.4 + rng.Uniform(-0.4, 0.4), rng.Uniform(-0.1, 0.1)});
  s.robot.error = {rng.Uniform(-0.14, 0.14), rng.Uniform(-0.14, 0.14), Radians(rng.Uniform(-5, 5))};
  s.robot.delay = std::chrono::milliseconds(50 + rng.Below(350));
  s.Start();
  s.robot.RunFor(90);
  RC_ASSERT(s.dut.state().phase == Phase::kDone);
  RC_ASSERT(s.robot.look_distance_m.size() >= 2u);
  for (int i = 0; i < 2; ++i) RC_ASSERT(s.robot.look_distance_m[i] > 1.7 && s.robot.look_distance_m[i] < 3.6);
  RC_ASSERT(s.robot.look_distance_m.back() > DoorMissionConfig().confirm_to_m - 0.5);
  for (const double speed_m_s : s.robot.look_speed_m_s) RC_ASSERT(speed_m_s > 0.1);
  // Footprint front and the 20 cm that the pose may be wrong: never nearer than half a metre to the wall.
  RC_ASSERT(s.robot.nearest_before_fix_m > 0.475 + 0.085 + 0.4);
}

TEST(DoorMission, WaitsForThePose) {
  DoorStory s;
  s.robot.silent = true;
  s.Start();
  s.robot.RunFor(2);
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting);
  s.robot.silent = false;
  s.robot.RunFor(1);
  EXPECT_EQ(s.dut.state().phase, Phase::kApproaching);
}

TEST(DoorMission, NoPoseAtAllEndsInASentence) {
  DoorStory s;
  s.robot.silent = true;
  s.Start();
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "no pose from the robot for 8 s: the radio link is down");
}

TEST(DoorMission, RadioThatDiesOnTheWayEndsTheMission) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kLookingLeft);
  s.robot.silent = true;
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("no pose from the robot for 8 s"));
}

TEST(DoorMission, APoseThatGrewUncertainOnTheWayTurnsBackBeforeTheOpening) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.sigma_after_m = 0.04;
  s.robot.RunUntil(Phase::kRetreating, 20);
  EXPECT_THAT(s.dut.state().text, HasSubstr("too uncertain for the gap"));
  EXPECT_LT(s.robot.truth().x, 6 - 0.085 - 0.475) << "no part of the base is in the opening";
  s.robot.RunFor(120);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, testing::Not(HasSubstr("look what it is")));
  EXPECT_LT(s.robot.truth().x, 6 - 0.085 - 0.475);
}

TEST(DoorMission, DoesNotPlanWithAPoseFromBeforeTheCorrection) {
  DoorMissionConfig config;
  config.passage.drift = {.yaw_rad_per_sqrt_m = 0, .lateral_m_per_sqrt_m = 0};
  DoorStory s({2.0, 2.4, 0}, ShippedPlan(), config);
  s.robot.sigma_m = s.robot.sigma_after_m;
  s.robot.sigma_yaw_rad = s.robot.sigma_yaw_after_rad;
  s.Start();
  s.robot.RunUntil(Phase::kLookingRight);
  const Time corrected = s.robot.now() + FromSeconds(0.4);
  s.dut.OnCorrected(corrected);
  s.dut.OnLook({s.robot.looks.back().request_id + 1, true, "", false});
  s.robot.RunFor(0.3);
  EXPECT_NE(s.dut.state().phase, Phase::kPassing);
  s.robot.RunUntil(Phase::kPassing, 2);
  EXPECT_EQ(s.dut.state().phase, Phase::kPassing);
  EXPECT_GT(s.robot.now(), corrected);
}

TEST(DoorMission, APoseHardlyYoungerThanTheCorrectionMayBeFromBeforeIt) {
  DoorMissionConfig config;
  config.passage.drift = {.yaw_rad_per_sqrt_m = 0, .lateral_m_per_sqrt_m = 0};
  DoorStory s({2.0, 2.4, 0}, ShippedPlan(), config);
  s.Start();
  s.robot.RunUntil(Phase::kLookingRight);
  const Time corrected = s.robot.now() + FromSeconds(0.1), now = corrected + FromSeconds(0.1);
  s.dut.OnCorrected(corrected);
  s.dut.OnLook({s.robot.looks.back().request_id + 1, true, "", false});
  const auto tick_with_pose_of = [&](Time stamp) {
    s.dut.OnPose({stamp, {3.5, 2.4, 0}, {}, Eigen::Matrix3d::Zero()});
    s.dut.Tick(now);
    return s.dut.state().phase;
  };
  EXPECT_NE(tick_with_pose_of(corrected + FromSeconds(0.02)), Phase::kPassing);
  EXPECT_EQ(tick_with_pose_of(corrected + FromSeconds(0.03)), Phase::kPassing);
}

TEST(DoorMission, APathThatEndsTooEarlyIsReportedOnceTheRobotStands) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunFor(1);
  Time now = s.robot.now();
  s.dut.OnDrive({DriveMode::kArrived, s.robot.paths.back().path_id, ""}, now);
  const auto tick_at_speed = [&](double vx) {
    now += FromSeconds(0.1);
    s.dut.OnPose({now, {5.5, 2.4, 0}, {vx, 0, 0}, Eigen::Matrix3d::Zero()});
    s.dut.Tick(now);
    return s.dut.state().phase;
  };
  EXPECT_EQ(tick_at_speed(0.03), Phase::kPassing);
  EXPECT_EQ(tick_at_speed(0.01), Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("the path ended 1.04 m before the door was passed"));
}

TEST(DoorMission, NarrowDoorIsRefusedBeforeMoving) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].opening_width_m = 0.75;
  DoorStory s({2.0, 2.4, 0}, plan);
  s.Start();
  s.robot.RunFor(5);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "door 'laboratory' is too narrow: needs 0.80 m, opening is 0.75 m");
  EXPECT_NEAR(s.robot.truth().x, 2.0, 1e-9);
}

TEST(DoorMission, UnknownDoorIsRefused) {
  DoorStory s;
  s.dut.Start(s.robot.now(), {kPassDoor, 7});
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "the map has no door 7");
}

TEST(DoorMission, AbortBrakes) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.dut.Abort();
  s.robot.Step();
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  for (int i = 0; i < 10; ++i) s.robot.Step();
  EXPECT_TRUE(s.robot.paths.back().points.empty());
}

TEST(DoorMission, SecondOrderWhileRunningIsRefused) {
  DoorStory s;
  s.Start();
  s.robot.RunFor(2);
  EXPECT_FALSE(s.dut.Start(s.robot.now(), {kPassDoor, 1}));
  EXPECT_EQ(s.dut.state().phase, Phase::kApproaching);
}

TEST(DoorMission, NewOrderAfterAFailureStartsAfresh) {
  DoorStory s;
  s.Start();
  s.robot.RunFor(2);
  s.dut.Abort();
  s.robot.Step();
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, PathThatTheRobotNeverConfirmsIsSentAgain) {
  DoorStory s;
  s.Start();
  s.robot.RunFor(1);
  ASSERT_EQ(s.robot.paths.size(), 1u);
  const int id = s.robot.paths[0].path_id;
  int repeats = 0;
  for (int i = 0; i < 100; ++i) {
    s.dut.OnDrive({DriveMode::kIdle, 0, ""}, s.robot.now());
    RobotPose pose{s.robot.now(), {1.0, 2.4, 0}, {}, Eigen::Matrix3d::Zero()};
    s.dut.OnPose(pose);
    const auto actions = s.dut.Tick(s.robot.now() + i * FromSeconds(0.05));
    if (actions.path && actions.path->path_id == id) ++repeats;
  }
  EXPECT_EQ(repeats, 1);
}

TEST(DoorMission, ShortApproachIsSlowLongApproachIsNot) {
  DoorStory near({3.0, 2.4, 0}), far({1.0, 2.4, 0});
  for (DoorStory* s : {&near, &far}) {
    s->Start();
    s->robot.RunFor(1);
  }
  EXPECT_NEAR(near.robot.paths[0].speed_m_s, (3.0 - 2.0) / 3.5, 1e-9);
  EXPECT_NEAR(far.robot.paths[0].speed_m_s, 0.3, 1e-9);
}

TEST(DoorMission, WorksAtADoorInAnyPoseOfTheMap) {
  const Pose2 turned{-7, 11, 2.3};
  DoorStory s(turned * Pose2{2.0, 2.2, 0.1}, Moved(ShippedPlan(), turned));
  s.robot.map_from_door = turned * s.robot.map_from_door;
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  const Pose2 end = turned.Inverse() * s.robot.truth();
  EXPECT_NEAR(end.x, 7.5, 0.01);
  EXPECT_NEAR(end.y, 2.4, 0.01);
}

}  // namespace
}  // namespace priamos::planner
