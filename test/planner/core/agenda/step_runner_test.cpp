#include "planner/core/agenda/step_runner.hpp"

#include <gmock/gmock.h>

#include "agenda_rig.hpp"

// The runner of steps in its agenda, with orders of one step.

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

TEST(StepRunner, APlaceInTheOtherRoomIsReachedThroughTheDoor) {
  AgendaRig rig;
  rig.Order({Go(8.3, 1.2, kPi / 2)});
  rig.robot.RunFor(120);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_THAT(rig.dut.state().text, HasSubstr("at (8.30, 1.20) after"));
  EXPECT_THAT(rig.dut.state().text, HasSubstr(", through door 'laboratory'"));
  EXPECT_NEAR(rig.robot.truth().x, 8.3, 0.01);
  EXPECT_GE(rig.robot.looks.size(), 2u);
}

TEST(StepRunner, AndBackThroughTheSameDoor) {
  AgendaRig rig({8.3, 1.2, kPi / 2});
  rig.Order({Go(2.0, 2.4, kPi)});
  rig.robot.RunFor(120);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_NEAR(rig.robot.truth().x, 2.0, 0.01);
  ASSERT_GE(rig.robot.looks.size(), 2u);
  EXPECT_EQ(rig.robot.looks[0].landmark_id, ShippedPlan().doors[0].behind_id);
}

TEST(StepRunner, ADoorIsPassedFromBehindWithItsOtherLandmark) {
  AgendaRig rig({8.6, 2.4, kPi});
  rig.Order({Door()});
  rig.robot.RunFor(120);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_NEAR(rig.robot.truth().x, 4.5, 0.01);
}

TEST(StepRunner, ADoorWithoutALandmarkBehindIsRefusedFromThereInWords) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].behind_id = 0;
  AgendaRig rig({8.6, 2.4, kPi}, plan);
  rig.Order({Door()});
  rig.robot.RunFor(20);
  EXPECT_EQ(rig.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(rig.dut.state().text,
            "the robot is 2.60 m behind door 'laboratory', and the map has no landmark there; next: give the "
            "door a "
            "behind_id");
  EXPECT_TRUE(rig.robot.paths.empty() || rig.robot.paths.back().points.empty());
}

TEST(StepRunner, ADoorIsDrivenToFromBesideIt) {
  AgendaRig rig({5.2, 0.9, kPi / 2});
  rig.Order({Door()});
  rig.robot.RunFor(120);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_NEAR(rig.robot.truth().x, 7.5, 0.01);
}

TEST(StepRunner, APlaceThatCannotBeReachedIsRefusedAndNothingMoves) {
  GroundPlan plan = ShippedPlan();
  plan.doors[0].opening_width_m = 0.7;
  AgendaRig rig({2.0, 2.4, 0}, plan);
  rig.Order({Go(8.3, 1.2)});
  rig.robot.RunFor(20);
  EXPECT_EQ(rig.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(rig.dut.state().text, HasSubstr("door 'laboratory' is too narrow"));
  EXPECT_TRUE(rig.robot.paths.empty());
}

TEST(StepRunner, WithoutTheRobotTheOrderFailsAfterAWhile) {
  AgendaRig rig;
  rig.robot.silent = true;
  rig.StepFor(2);
  rig.Order({Go(4, 2.4)});
  rig.StepFor(7);
  EXPECT_TRUE(rig.dut.running());
  EXPECT_EQ(rig.dut.state().text, "waiting for the robot's pose");
  rig.StepFor(2);
  EXPECT_THAT(rig.dut.state().text, HasSubstr("no pose from the robot for 8 s"));
}

TEST(StepRunner, AnOrderWhileSomebodyDrivesByHandSaysThatItWaits) {
  AgendaRig rig;
  rig.robot.by_hand = true;
  rig.StepFor(1);
  rig.Order({Go(4, 2.4)});
  rig.StepFor(2);
  EXPECT_THAT(rig.dut.state().text, testing::StartsWith("begins when nobody drives by hand; "));
  rig.robot.by_hand = false;
  rig.StepFor(1);
  EXPECT_THAT(rig.dut.state().text, testing::Not(HasSubstr("by hand")));
}

TEST(StepRunner, ABlackoutOnTheWayIsDrivenThroughAndToldAfterwards) {
  AgendaRig rig({1.0, 2.4, 0});
  rig.Order({Go(5.0, 2.4)});
  rig.robot.RunUntilX(2);
  rig.robot.silent = true;
  rig.StepFor(30);
  EXPECT_TRUE(rig.dut.running());
  EXPECT_THAT(rig.dut.state().text, HasSubstr("no news of the robot"));
  EXPECT_NEAR(rig.robot.truth().x, 5.0, 0.01) << "its path led there";
  rig.robot.silent = false;
  rig.robot.RunFor(5);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_THAT(rig.dut.state().text, HasSubstr("; the robot was out of reach for 30 s"));
}

TEST(StepRunner, ABlackoutBetweenTheLooksDelaysTheDoorAndNoMore) {
  AgendaRig rig;
  rig.Order({Go(8.3, 1.2)});
  rig.robot.RunUntil(Phase::kLookingRight);
  rig.robot.silent = true;
  rig.StepFor(60);
  EXPECT_TRUE(rig.dut.running());
  EXPECT_LT(rig.robot.truth().x, 4.5) << "it holds before the door";
  rig.robot.silent = false;
  rig.robot.RunFor(120);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
}

TEST(StepRunner, ABlackoutThatDoesNotEndFailsTheOrder) {
  AgendaRig rig({1.0, 2.4, 0}, ShippedPlan(), {.blackout_s = 40});
  rig.Order({Go(5.0, 2.4)});
  rig.robot.RunUntilX(2);
  rig.robot.silent = true;
  rig.StepFor(45);
  EXPECT_FALSE(rig.dut.running());
  EXPECT_THAT(rig.dut.state().text, HasSubstr("no pose from the robot for 40 s"));
}

TEST(StepRunner, PausedInTheDoorItGoesOnThroughIt) {
  AgendaRig rig;
  rig.Order({Door()});
  rig.robot.RunUntilX(5.9);
  EXPECT_TRUE(rig.dut.Pause(rig.robot.now()));
  rig.StepFor(3);
  const double held_x = rig.robot.truth().x;
  EXPECT_LT(held_x, 6.2);
  EXPECT_THAT(rig.dut.state().text, HasSubstr("paused: the robot holds its place"));
  rig.StepFor(200);
  EXPECT_EQ(rig.robot.truth().x, held_x);
  EXPECT_TRUE(rig.dut.running()) << "its time does not run out";
  EXPECT_TRUE(rig.dut.Resume(rig.robot.now()));
  rig.robot.RunFor(60);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
  EXPECT_NEAR(rig.robot.truth().x, 7.5, 0.01);
  EXPECT_NEAR(rig.robot.truth().y, 2.4, 0.01);
}

TEST(StepRunner, APauseInABlackoutIsNoPauseYet) {
  AgendaRig rig;
  rig.Order({Go(4.8, 2.4)});
  rig.robot.RunUntilX(2.6);
  rig.robot.silent = true;
  rig.StepFor(2);
  rig.dut.Pause(rig.robot.now());
  rig.StepFor(0.5);
  EXPECT_GT(rig.robot.speed_m_s(), 0.1);
  EXPECT_THAT(rig.dut.state().text, HasSubstr("pause ordered; nothing is heard from the robot"));
  rig.robot.silent = false;
  rig.StepFor(20);
  EXPECT_THAT(rig.dut.state().text, HasSubstr("paused: the robot holds its place"));
  EXPECT_EQ(rig.robot.speed_m_s(), 0);
  EXPECT_LT(rig.robot.truth().x, 4.4);
}

TEST(StepRunner, AnAbortInABlackoutIsRepeatedWhenTheRobotIsHeardAgain) {
  AgendaRig rig;
  rig.Order({Go(4.8, 2.4)});
  rig.robot.RunUntilX(2.6);
  rig.robot.silent = true;
  rig.StepFor(1.5);
  rig.dut.Abort(rig.robot.now());
  rig.StepFor(1);
  rig.robot.silent = false;
  rig.StepFor(1.5);
  EXPECT_FALSE(rig.dut.running());
  EXPECT_EQ(rig.robot.speed_m_s(), 0);
  EXPECT_LT(rig.robot.truth().x, 4.4);
}

TEST(StepRunner, PausedBetweenTheLooksItLooksOnAfterwards) {
  AgendaRig rig;
  rig.Order({Door()});
  rig.robot.RunUntil(Phase::kLookingRight);
  rig.dut.Pause(rig.robot.now());
  rig.StepFor(30);
  rig.dut.Resume(rig.robot.now());
  rig.robot.RunFor(120);
  EXPECT_EQ(rig.dut.state().phase, Phase::kDone) << rig.dut.state().text;
}

TEST(StepRunner, AnEmergencyStopEndsAPausedMission) {
  AgendaRig rig;
  rig.Order({Door()});
  rig.robot.RunUntilX(3);
  rig.dut.Pause(rig.robot.now());
  rig.StepFor(1);
  rig.missions.OnDrive({.mode = DriveMode::kHolding, .limit = "", .estop = true, .estop_changes = 1},
                       rig.robot.now());
  rig.dut.Tick(rig.robot.now());
  EXPECT_FALSE(rig.dut.running());
  EXPECT_THAT(rig.dut.state().text, HasSubstr("the emergency stop is latched"));
}

TEST(StepRunner, TheTimeLeftIsAboutRight) {
  AgendaRig rig;
  rig.Order({Go(8.3, 1.2)});
  rig.StepFor(0.1);
  const double expected_s = *rig.dut.Left_s(rig.robot.now());
  const Time begun = rig.robot.now();
  rig.robot.RunFor(200);
  const double took_s = Seconds(rig.robot.now() - begun);
  EXPECT_NEAR(expected_s, took_s, 0.35 * took_s);
}

}  // namespace
}  // namespace priamos::planner
