#include "planner/core/missions/door_mission.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "common/random.hpp"
#include "fake_robot.hpp"
#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;

constexpr int kPassDoor = 1;

/// The door mission in its frame, and the robot that it drives.
struct Story {
  explicit Story(const Pose2& truth = {2.0, 2.4, 0}, const GroundPlan& plan = ShippedPlan(),
                 const DoorMissionConfig& config = {})
      : robot(dut, truth) {
    dut.Add(kPassDoor, std::make_unique<DoorMission>(config, DoorPlannerConfig{}, Footprint{}, plan));
  }
  void Start() { EXPECT_TRUE(dut.Start(robot.now(), {kPassDoor, 1})); }

  MissionTable dut;
  FakeRobot robot;
};

TEST(DoorMission, SendsNothingBeforeTheFirstOrder) {
  Story s;
  s.robot.RunFor(3);
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting);
  EXPECT_TRUE(s.robot.paths.empty());
  EXPECT_EQ(s.robot.models_received, 0);
}

TEST(DoorMission, PassesTheDoor) {
  Story s;
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
  Story s;
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
    Story s;
    s.robot.deaf = true;
    s.Start();
    s.robot.RunUntil(Phase::kPassing);
    s.dut.OnOpening(other);
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, Phase::kFailed) << other.map_from_base.x;
  }
}

LeafSighting Leaf(double open_deg) {
  return {Time{}, 1, "left", Radians(open_deg), Radians(0.7), 6};
}

TEST(DoorMission, ALeafInTheWayIsRefusedBeforeTheDoor) {
  Story s;
  s.robot.leaf = Leaf(45);
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text,
            "door 'laboratory' stands open only 45 degrees: 0.24 m are free, 0.80 m needed");
  EXPECT_LT(s.robot.truth().x, 6 - 0.085 - 0.475 - 1);
}

TEST(DoorMission, ALeafThatLeavesTheWayFreeOrMayDoSoIsNoReasonToRefuse) {
  for (const double deg : {92.0, 84.0}) {
    Story s;
    s.robot.leaf = Leaf(deg);
    s.Start();
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, Phase::kDone) << deg << ": " << s.dut.state().text;
  }
}

TEST(DoorMission, TheLeafOfAnotherDoorOrOfAnEarlierMissionIsNotThisOne) {
  for (LeafSighting other : {LeafSighting{FromUtime(1'020'000'000), 2, "left", Radians(45), 0.01, 9},
                             LeafSighting{FromUtime(999'000'000), 1, "left", Radians(45), 0.01, 9}}) {
    Story s;
    s.Start();
    s.robot.RunUntil(Phase::kLookingRight);
    s.dut.OnLeaf(other);
    s.dut.OnLeaf(other);
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  }
}

TEST(DoorMission, AfterATouchItGoesBackAndEnds) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunUntilX(5.8);
  s.robot.touched = true;
  s.robot.RunFor(1);
  EXPECT_EQ(s.dut.state().phase, Phase::kRetreating);
  EXPECT_EQ(s.dut.state().text, "the robot touched something: back to the place before the door");
  s.robot.RunFor(30);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("the robot touched something; next: look what it is"));
  EXPECT_LT(s.robot.truth().x, 6 - 0.085 - 0.475 - 1);
}

TEST(DoorMission, WhatStoodInTheDoorMayHaveGoneWhenItComesAgain) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunUntilX(5.4);
  s.robot.blocked = true;
  s.robot.RunUntil(Phase::kRetreating, 10);
  EXPECT_THAT(s.dut.state().text, HasSubstr("blocked for 8 s: sonar"));
  s.robot.blocked = false;
  const std::size_t looks = s.robot.looks.size();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_GT(s.robot.looks.size(), looks + 1) << "it looked again";
}

TEST(DoorMission, BlockedTwiceInTheDoorItEndsBeforeIt) {
  Story s;
  s.Start();
  for (int i = 0; i < 2; ++i) {
    s.robot.RunUntil(Phase::kPassing);
    s.robot.RunUntilX(5.4);
    s.robot.blocked = true;
    s.robot.RunUntil(Phase::kRetreating, 10);
    s.robot.RunFor(1);
    s.robot.blocked = false;
  }
  s.robot.RunFor(30);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("was blocked for 8 s: sonar; next:"));
  EXPECT_LT(s.robot.truth().x, 6 - 0.085 - 0.475 - 1);
}

TEST(DoorMission, BlockedBeforeAndBehindItStays) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunUntilX(5.7);
  s.robot.blocked = true;
  s.robot.RunFor(30);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("and on its way back the robot was blocked for 8 s"));
}

TEST(DoorMission, BlockedOnItsWayBackItLooksAgainFromThereWhenTheDoorwayIsFree) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunUntilX(5.4);
  s.robot.blocked = true;
  s.robot.RunUntil(Phase::kRetreating);
  s.robot.RunFor(10);
  s.robot.blocked = false;
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, LooksAtTheLeftSideFirstThenAtTheRightSide) {
  Story s;
  s.Start();
  s.robot.RunFor(60);
  ASSERT_GE(s.robot.looks.size(), 2u);
  EXPECT_EQ(s.robot.looks[0].side, Side::kLeft);
  EXPECT_EQ(s.robot.looks[1].side, Side::kRight);
}

RC_GTEST_PROP(DoorMission, LooksWhileDrivingAtAGoodDistanceFromAnyStart, (const unsigned seed)) {
  Rng rng(seed);
  Story s({6 - rng.Uniform(3, 5), 2.4 + rng.Uniform(-0.4, 0.4), rng.Uniform(-0.1, 0.1)});
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
  Story s;
  s.robot.silent = true;
  s.Start();
  s.robot.RunFor(2);
  EXPECT_EQ(s.dut.state().phase, Phase::kWaiting);
  s.robot.silent = false;
  s.robot.RunFor(1);
  EXPECT_EQ(s.dut.state().phase, Phase::kApproaching);
}

TEST(DoorMission, NoPoseAtAllEndsInASentence) {
  Story s;
  s.robot.silent = true;
  s.Start();
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "no pose from the robot for 8 s: the radio link is down");
}

TEST(DoorMission, RadioThatDiesOnTheWayEndsTheMission) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kLookingLeft);
  s.robot.silent = true;
  s.robot.RunFor(20);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("no pose from the robot for 8 s"));
}

TEST(DoorMission, SideThatWasNotFoundIsLookedAtAgainAfterTheOther) {
  Story s;
  s.robot.answer = [](const LookOrder& look, int n) {
    return LookResult{look.request_id, n != 0, n != 0 ? "" : "too few edges", false};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  ASSERT_GE(s.robot.looks.size(), 3u);
  EXPECT_EQ(s.robot.looks[1].side, Side::kRight);
  EXPECT_EQ(s.robot.looks[2].side, Side::kLeft);
  EXPECT_NE(s.robot.looks[0].request_id, s.robot.looks[1].request_id);
  EXPECT_EQ(s.robot.models_received, 1);
}

TEST(DoorMission, DoorWithOneSideOutOfSightIsPassedAllTheSame) {
  Story s;
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, look.side == Side::kRight, "not visible from there", false};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, HeadThatLostTheModelGetsItAgainBeforeTheNextLook) {
  Story s;
  s.robot.answer = [&s](const LookOrder& look, int n) {
    EXPECT_EQ(s.robot.models_received, n == 0 ? 1 : 2);
    return LookResult{look.request_id, n != 0, "the head has no model of it", n == 0};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, SaysWhyItLooksAgain) {
  Story s;
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "no image", false};
  };
  s.Start();
  for (int i = 0; i < 1000 && s.dut.state().text.find("not found") == std::string::npos; ++i) s.robot.Step();
  EXPECT_EQ(s.dut.state().text, "left side of the door not found: no image");
  EXPECT_EQ(s.dut.state().phase, Phase::kLookingLeft);
}

/// From near a picture holds too little of the door to find it where its place is hardly known.
TEST(DoorMission, LooksThatFailFromNearAreRepeatedFromFartherBack) {
  Story s;
  s.robot.answer = [&s](const LookOrder& look, int) {
    return LookResult{look.request_id, s.robot.truth().x < 6 - 2.4 && s.robot.paths.size() > 1, "", false};
  };
  s.Start();
  s.robot.RunUntil(Phase::kRetreating);
  EXPECT_GT(s.robot.truth().x, 6 - 1.9);
  EXPECT_THAT(s.dut.state().text, HasSubstr("9 looks failed"));
  EXPECT_THAT(s.dut.state().text, HasSubstr("back to 2.6 m before the door, to see more of it"));
  s.robot.RunUntil(Phase::kLookingLeft);
  EXPECT_NEAR(s.robot.truth().x, 6 - 2.6, 0.05);
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, GivesUpWithTheReasonAndBrakes) {
  Story s;
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "ambiguous", false};
  };
  s.Start();
  s.robot.RunFor(90);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("looks failed, the last one: left side of the door not found"));
  for (int i = 0; i < 10; ++i) s.robot.Step();
  EXPECT_TRUE(s.robot.paths.back().points.empty());
  EXPECT_NEAR(s.robot.truth().x, 6 - 2.6, 0.05) << "it went back once, and stays there";
}

/// Who cannot go back, or shall not, gives up where it stands.
TEST(DoorMission, WithoutRoomBehindItGivesUpAtTheHoldPoint) {
  DoorMissionConfig config;
  config.stand_back_m = 0;
  Story s({2.0, 2.4, 0}, ShippedPlan(), config);
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "ambiguous", false};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "9 looks failed, the last one: left side of the door not found: ambiguous");
  EXPECT_GT(s.robot.truth().x, 6 - 1.9);
}

TEST(DoorMission, AnswerToAnEarlierRequestIsNotTaken) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kLookingLeft);
  s.dut.OnLook({1, true, "", false});
  s.robot.Step();
  EXPECT_EQ(s.dut.state().phase, Phase::kLookingLeft);
}

TEST(DoorMission, HeadThatNeverAnswersIsAskedAgainThenGivenUp) {
  Story s;
  s.robot.look_time = std::chrono::seconds(1000);
  s.Start();
  s.robot.RunFor(110);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("side of the door not found: no answer"));
}

TEST(DoorMission, UncertainPoseIsLookedAtAgainAndThenRefused) {
  Story s;
  s.robot.sigma_after_m = 0.05;
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("too uncertain for the gap"));
  EXPECT_EQ(s.robot.looks.size(), 16u);
  EXPECT_LT(s.robot.truth().x, 6 - 1.1);
}

TEST(DoorMission, PassesWithoutStoppingWhenBothSidesWereSeenSinceLooksGoOn) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  ASSERT_EQ(s.robot.looks.size(), 2u);
  EXPECT_NE(s.robot.looks[0].side, s.robot.looks[1].side);
  EXPECT_LT(s.robot.look_distance_m[1], s.robot.look_distance_m[0]);
  EXPECT_GT(s.robot.speed_m_s(), 0.2);
}

TEST(DoorMission, LooksGoOnWhilePassingUntilTheJambsLeaveThePicture) {
  Story s;
  s.robot.sigma_m = s.robot.sigma_after_m = 0.002;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  const std::size_t before = s.robot.looks.size();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_GT(s.robot.looks.size(), before);
  EXPECT_GT(s.robot.look_distance_m.back(), DoorMissionConfig().confirm_to_m - 0.4);
}

TEST(DoorMission, NearTheDoorLooksStayOnOneSide) {
  Story s;
  s.robot.sigma_m = s.robot.sigma_after_m = 0.002;
  s.Start();
  s.robot.RunFor(60);
  int near = 0;
  for (std::size_t i = 1; i < s.robot.looks.size(); ++i) {
    if (s.robot.look_distance_m[i] > DoorMissionConfig().one_side_m - 0.3) continue;
    ++near;
    EXPECT_EQ(s.robot.looks[i].side, s.robot.looks[i - 1].side) << s.robot.look_distance_m[i];
  }
  EXPECT_GE(near, 1);
}

TEST(DoorMission, ABaseThatWaitedLongInTheApproachStillLooks) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.blocked = true;
  const std::size_t before = s.robot.looks.size();
  s.robot.RunFor(7);
  s.robot.blocked = false;
  const std::size_t waiting = s.robot.looks.size();
  s.robot.RunFor(60);
  EXPECT_GT(waiting, before);
  EXPECT_GT(s.robot.looks.size(), waiting + 1) << "looks that succeeded were counted as used up";
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, APoseThatGrewUncertainOnTheWayTurnsBackBeforeTheOpening) {
  Story s;
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
  Story s({2.0, 2.4, 0}, ShippedPlan(), config);
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
  Story s({2.0, 2.4, 0}, ShippedPlan(), config);
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
  Story s;
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

TEST(DoorMission, BlockedOnTheWayItTriesAgainWhereItStands) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunFor(0.3);
  const double x_m = s.robot.truth().x;
  s.robot.blocked = true;
  s.robot.RunFor(40);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text,
            "the robot was blocked for 8 s: sonar; next: look what it is, and order it again");
  EXPECT_EQ(s.robot.truth().x, x_m);
}

TEST(DoorMission, ShortBlockadeIsWaitedOut) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunFor(1);
  s.robot.blocked = true;
  s.robot.RunFor(4);
  s.robot.blocked = false;
  s.robot.RunFor(30);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, NarrowDoorIsRefusedBeforeMoving) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].opening_width_m = 0.75;
  Story s({2.0, 2.4, 0}, plan);
  s.Start();
  s.robot.RunFor(5);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "door 'laboratory' is too narrow: needs 0.80 m, opening is 0.75 m");
  EXPECT_NEAR(s.robot.truth().x, 2.0, 1e-9);
}

TEST(DoorMission, UnknownDoorIsRefused) {
  Story s;
  s.dut.Start(s.robot.now(), {kPassDoor, 7});
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text, "the map has no door 7");
}

TEST(DoorMission, AbortBrakes) {
  Story s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.dut.Abort();
  s.robot.Step();
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  for (int i = 0; i < 10; ++i) s.robot.Step();
  EXPECT_TRUE(s.robot.paths.back().points.empty());
}

TEST(DoorMission, SecondOrderWhileRunningIsRefused) {
  Story s;
  s.Start();
  s.robot.RunFor(2);
  EXPECT_FALSE(s.dut.Start(s.robot.now(), {kPassDoor, 1}));
  EXPECT_EQ(s.dut.state().phase, Phase::kApproaching);
}

TEST(DoorMission, NewOrderAfterAFailureStartsAfresh) {
  Story s;
  s.Start();
  s.robot.RunFor(2);
  s.dut.Abort();
  s.robot.Step();
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorMission, PathThatTheRobotNeverConfirmsIsSentAgain) {
  Story s;
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
  Story near({3.0, 2.4, 0}), far({1.0, 2.4, 0});
  for (Story* s : {&near, &far}) {
    s->Start();
    s->robot.RunFor(1);
  }
  EXPECT_NEAR(near.robot.paths[0].speed_m_s, (3.0 - 2.0) / 3.5, 1e-9);
  EXPECT_NEAR(far.robot.paths[0].speed_m_s, 0.3, 1e-9);
}

TEST(DoorMission, WorksAtADoorInAnyPoseOfTheMap) {
  const Pose2 turned{-7, 11, 2.3};
  Story s(turned * Pose2{2.0, 2.2, 0.1}, Moved(ShippedPlan(), turned));
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
