#include "robot/core/motion/drive_controller.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "test/robot/support/robot_rig.hpp"

namespace priamos::robot {
namespace {

using testing::Each;

Path Straight(int id = 1) {
  return {.id = id, .speed_m_s = 0.4, .points = {{5, 0, 0}}};
}
Path Stop(int id = 9) {
  return {.id = id, .speed_m_s = 0, .points = {}};
}

class DriveControllerTest : public testing::Test {
 protected:
  double Speed() { return std::hypot(rig_.base().twist().vx, rig_.base().twist().vy); }

  RobotRig rig_{1, {0, 0, 0}};
};

TEST_F(DriveControllerTest, IsSilentBeforeTheFirstPath) {
  rig_.Run(1);
  EXPECT_FALSE(rig_.command());
  EXPECT_EQ(rig_.state().mode, DriveMode::kIdle);
  EXPECT_EQ(rig_.state().path_id, 0);
}

TEST_F(DriveControllerTest, FollowsAPathAndArrives) {
  rig_.Run(0.2);
  rig_.SetPath(Straight(7));
  rig_.Run(3);
  EXPECT_EQ(rig_.state().mode, DriveMode::kFollowing);
  EXPECT_EQ(rig_.state().path_id, 7);
  EXPECT_NEAR(Speed(), 0.4, 0.03);
  rig_.Run(14);
  EXPECT_EQ(rig_.state().mode, DriveMode::kArrived);
  EXPECT_EQ(rig_.state().failsafe.action, FailsafeAction::kNone);
  EXPECT_LT(rig_.state().remaining_m, 0.01);
  ASSERT_TRUE(rig_.command());
  EXPECT_THAT(*rig_.command(), Each(0.0));
}

TEST_F(DriveControllerTest, APathThatComesBeforeTheFirstEncoderSampleWaits) {
  rig_.wheels_answer = false;
  rig_.SetPath(Straight());
  rig_.Run(0.5);
  EXPECT_LT(Speed(), 1e-6);
  EXPECT_EQ(rig_.state().failsafe.cause, Condition::kWheelsSilent);
  rig_.wheels_answer = true;
  rig_.Run(3);
  EXPECT_GT(Speed(), 0.3);
}

TEST_F(DriveControllerTest, APathWithoutPointsBrakesAndHolds) {
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.SetPath(Stop(8));
  rig_.Run(1);
  EXPECT_EQ(rig_.state().mode, DriveMode::kHolding);
  EXPECT_EQ(rig_.state().path_id, 8);
  EXPECT_LT(Speed(), 1e-3);
  EXPECT_THAT(*rig_.command(), Each(0.0)) << "explicit zeros while holding";
}

TEST_F(DriveControllerTest, TheSamePathAgainChangesNothing) {
  const Path path{.id = 3, .speed_m_s = 0.4, .points = {{1, 0, 0}, {5, 0, 0}}};
  rig_.SetPath(path);
  rig_.Run(5);
  const double x = rig_.base().truth().x;
  ASSERT_GT(x, 1.4);
  rig_.SetPath(path);
  for (int i = 0; i < 100; ++i) {
    rig_.Tick();
    EXPECT_GT(rig_.base().twist().vx, 0.3);
  }
}

TEST_F(DriveControllerTest, ItStandsBeforeATableTopThatOnlyTheHeadSees) {
  SeenThing table;
  table.seen = rig_.now();
  table.map_from_front = {2.5, 0, 0};
  table.width_m = 1.2;
  table.depth_m = 0.6;
  table.bottom_m = 0.67;
  table.top_m = 0.72;
  rig_.Run(0.2);
  rig_.SetPath(Straight());
  rig_.Run(1);
  rig_.drive().AddSeenThing(table, {});
  rig_.Run(10);
  EXPECT_EQ(rig_.state().mode, DriveMode::kBlocked);
  EXPECT_GT(rig_.base().truth().x, 1.5);
  EXPECT_LT(rig_.base().truth().x, 2.5 - 0.475);
  table.has_gone = true;
  rig_.drive().AddSeenThing(table, {});
  rig_.Run(8);
  EXPECT_GT(rig_.base().truth().x, 3) << "it has gone";
}

TEST_F(DriveControllerTest, EncodersFallSilentTheBaseBrakesAndGoesOnWhenTheyAreBack) {
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.wheels_answer = false;
  rig_.Run(0.8);
  EXPECT_EQ(rig_.state().failsafe.cause, Condition::kWheelsSilent);
  EXPECT_LT(Speed(), 1e-3);
  rig_.wheels_answer = true;
  rig_.Run(2);
  EXPECT_EQ(rig_.state().mode, DriveMode::kFollowing);
  EXPECT_GT(Speed(), 0.3);
}

TEST_F(DriveControllerTest, SonarsFallSilentTheBaseBrakes) {
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.sonars_answer = false;
  rig_.Run(1.2);
  EXPECT_EQ(rig_.state().failsafe.cause, Condition::kSonarSilent);
  EXPECT_LT(Speed(), 1e-3);
}

TEST_F(DriveControllerTest, ATouchEndsThePathAtOnceAndSaysWhere) {
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.drive().touch_watch().AddBumper(1, rig_.now());
  rig_.Tick();
  EXPECT_EQ(rig_.state().failsafe.cause, Condition::kTouched);
  EXPECT_THAT(*rig_.command(), Each(0.0));
  ASSERT_TRUE(rig_.state().touch);
  EXPECT_EQ(rig_.state().touch->segments, 1);
  rig_.Run(1);
  EXPECT_EQ(rig_.state().mode, DriveMode::kHolding);
  EXPECT_EQ(rig_.state().halted_by, Condition::kTouched);
}

TEST_F(DriveControllerTest, WhatWasOnItsWayWhenSomethingWasTouchedDoesNotCoverItUp) {
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.drive().touch_watch().AddBumper(1, rig_.now());
  rig_.Tick();
  EXPECT_EQ(rig_.SetPath({.id = 2, .speed_m_s = 0.3, .points = {{5, 1, 0}}}), PathVerdict::kTouched);
  rig_.SetPath({.id = 3});  // an order to stand
  rig_.Run(1);
  EXPECT_EQ(rig_.state().halted_by, Condition::kTouched);
  rig_.Run(1);
  EXPECT_EQ(rig_.SetPath({.id = 4, .speed_m_s = 0.3, .points = {{-1, 0, 0}}}), PathVerdict::kTaken);
  EXPECT_FALSE(rig_.state().halted_by);
}

TEST_F(DriveControllerTest, AnOperatorWhoPushesOnIsToldOfTheTouchFirst) {
  const LeaseHolder teleop{Driver::kTeleop, 1};
  rig_.TakeOver(teleop);
  rig_.Hold(teleop, {0.2, 0, 0}, 1);
  rig_.drive().touch_watch().AddBumper(1, rig_.now());
  rig_.Hold(teleop, {0.2, 0, 0}, 1);
  EXPECT_EQ(rig_.state().halted_by, Condition::kTouched);
  rig_.Hold(teleop, {0, 0, 0}, 0.2);
  EXPECT_EQ(rig_.state().halted_by, Condition::kTouched) << "letting go does not cover it up";
  rig_.Hold(teleop, {-0.2, 0, 0}, 1);
  EXPECT_FALSE(rig_.state().halted_by);
}

TEST_F(DriveControllerTest, ABaseThatStillRollsAfterItsPathWasDroppedTellsOfATouch) {
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.SetPath({.id = 2});
  rig_.Run(0.1);
  rig_.drive().touch_watch().AddBumper(1, rig_.now());
  rig_.Run(1);
  EXPECT_EQ(rig_.state().halted_by, Condition::kTouched);
}

TEST_F(DriveControllerTest, AfterATouchNothingMovesTowardsThePlaceAndAnOperatorCanBackOff) {
  const LeaseHolder teleop{Driver::kTeleop, 1};
  rig_.SetPath(Straight());
  rig_.Run(3);
  rig_.drive().touch_watch().AddBumper(1, rig_.now());
  rig_.Run(1);
  const double x = rig_.base().truth().x;
  rig_.TakeOver(teleop);
  rig_.Hold(teleop, {0.2, 0, 0}, 1);
  EXPECT_LT(rig_.base().truth().x, x + 0.01);
  rig_.Hold(teleop, {-0.2, 0, 0}, 2);
  EXPECT_LT(rig_.base().truth().x, x - 0.2);
}

TEST(DriveControllerWithBumper, HoldsWhileItsBumperIsSilent) {
  DriveConfig config;
  config.touch.bumper = true;
  RobotRig rig(1, {0, 0, 0}, LocaliserConfig(), config);
  const auto run = [&rig](double seconds, bool bumper_answers) {
    for (int i = 0; i < seconds * 50; ++i) {
      if (bumper_answers) rig.drive().touch_watch().AddBumper(0, rig.now());
      rig.Tick();
    }
  };
  run(0.5, true);
  rig.SetPath(Straight());
  run(3, true);
  EXPECT_EQ(rig.state().failsafe.action, FailsafeAction::kNone);
  run(1.5, false);
  EXPECT_EQ(rig.state().failsafe.cause, Condition::kBumperSilent);
  EXPECT_LT(std::abs(rig.base().twist().vx), 1e-3);
  run(3, true);
  EXPECT_EQ(rig.state().mode, DriveMode::kFollowing);
}

TEST_F(DriveControllerTest, WheelsThatDoNotTurnEndThePath) {
  rig_.Run(0.2);
  rig_.wheels_turn = false;
  rig_.SetPath(Straight());
  bool halted = false;
  for (int i = 0; i < 150; ++i) {
    rig_.Tick();
    halted = halted || rig_.state().failsafe.cause == Condition::kWheelsStuck;
  }
  EXPECT_TRUE(halted);
  EXPECT_EQ(rig_.state().mode, DriveMode::kHolding);
  rig_.wheels_turn = true;
  rig_.Run(1);
  EXPECT_LT(Speed(), 1e-6) << "only a new path moves it again";
}

TEST(DriveController, DoesNotDriveByAPoseThatIsTooUncertain) {
  LocaliserConfig lost;
  lost.estimator.initial.position_error_m = 2;
  RobotRig rig(1, {0, 0, 0}, lost);
  rig.SetPath(Straight());
  rig.Run(2);
  EXPECT_EQ(rig.state().failsafe.cause, Condition::kPoseLost);
  EXPECT_EQ(rig.base().truth().x, 0);
}

TEST(DriveController, StandsBeforeABoxAndSaysBlockedAndGoesOnWhenItIsGone) {
  // The wall behind it shows that it is gone.
  RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(2, -0.2, 2.3, 0.2));
  rig.SetPath(Straight());
  rig.Run(8);
  EXPECT_EQ(rig.state().mode, DriveMode::kBlocked);
  EXPECT_TRUE(rig.state().slowed_by_sonar);
  ASSERT_TRUE(rig.state().nearest);
  EXPECT_LT(rig.state().nearest->free_m, 0.15);
  EXPECT_GT(rig.min_gap(), 0.02);
  rig.sonars().Clear();
  rig.sonars().Add(BoxSides(6.0, -2, 6.5, 2));
  rig.Run(3);
  EXPECT_EQ(rig.state().mode, DriveMode::kFollowing);
}

/// How far the front of the base is from a place on the x axis.
double Before(RobotRig& rig, double x) {
  return x - rig.base().truth().x - Footprint{}.length_m / 2;
}

/// Somebody comes straight towards the base, from 4.5 m, until he is `near_m` before it.
void Approach(RobotRig& rig, double speed_m_s, double near_m) {
  for (double x = rig.base().truth().x + 5; Before(rig, x) > near_m; x -= speed_m_s * 0.02) {
    rig.sonars().Clear();
    rig.sonars().Add(BoxSides(x, -0.2, x + 0.3, 0.2));
    rig.Tick();
  }
}

TEST(DriveController, InACorridorItStandsWhenSomebodyWalksIntoIt) {
  for (const double speed_m_s : {0.6, 1.2}) {
    RobotRig rig(1, {0, 0, 0});
    Path corridor = Straight();
    corridor.centre = true;
    rig.SetPath(corridor);
    rig.Run(2);
    EXPECT_GT(rig.base().twist().vx, 0.3) << speed_m_s;
    Approach(rig, speed_m_s, 0.4);
    EXPECT_LT(rig.base().twist().vx, 0.01) << speed_m_s << ": with room for feet";
  }
}

TEST(DriveController, ABaseThatFindsNoWayAroundSaysSoAndWhatIsBeforeIt) {
  // Closed in on all sides but behind: there is no motion that the collision stop could limit.
  RobotRig rig(1, {}, {}, {}, {{{1.4, -3}, {1.4, 3}}, {{-2, 0.9}, {1.4, 0.9}}, {{-2, -0.9}, {1.4, -0.9}}});
  rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{5, 0, 0}}, .leeway = {{0.5, 0.5}}});
  rig.Run(12);
  EXPECT_EQ(rig.state().mode, DriveMode::kBlocked);
  EXPECT_TRUE(rig.state().slowed_by_sonar);
  ASSERT_TRUE(rig.state().nearest);
  EXPECT_GT(rig.state().nearest->point.x(), 0.4);
}

TEST(DriveController, WhoTouchesABaseThatHasNoWayToGoIsToldUntilHeHasLeft) {
  RobotRig rig(1, {});
  rig.Run(0.5);
  rig.drive().touch_watch().AddBumper(1, rig.now());
  for (int i = 0; i < 20; ++i) {
    rig.Run(0.1);
    EXPECT_TRUE(rig.state().bumped) << i;
  }
  EXPECT_FALSE(rig.state().halted_by);
  rig.drive().touch_watch().AddBumper(0, rig.now());
  rig.Run(1);
  EXPECT_TRUE(rig.state().bumped) << "until everybody has been told";
  rig.Run(1);
  EXPECT_FALSE(rig.state().bumped);
}

TEST(DriveController, WhoTouchesTheStandingBaseHoldsItAndItGoesOnWhenHeHasLeft) {
  RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(2, -0.2, 2.3, 0.2));
  rig.SetPath(Straight());
  rig.Run(8);
  ASSERT_EQ(rig.state().mode, DriveMode::kBlocked);
  rig.drive().touch_watch().AddBumper(1, rig.now());
  rig.Run(2);
  EXPECT_EQ(rig.state().failsafe.cause, Condition::kBumped);
  ASSERT_TRUE(rig.state().touch);
  EXPECT_TRUE(rig.state().touch->came);
  EXPECT_FALSE(rig.state().halted_by);
  rig.drive().touch_watch().AddBumper(0, rig.now());
  rig.sonars().Clear();
  rig.sonars().Add(BoxSides(6.0, -2, 6.5, 2));
  rig.Run(1);
  EXPECT_EQ(rig.state().failsafe.cause, Condition::kBumped) << "until everybody has been told";
  rig.Run(4);
  EXPECT_EQ(rig.state().failsafe.action, FailsafeAction::kNone);
  EXPECT_GT(rig.base().twist().vx, 0.3);
}

TEST(DriveController, APathForABaseThatSomebodyTouchesBeginsWhenHeHasLeft) {
  RobotRig rig(1, {0, 0, 0});
  rig.SetPath({.id = 1, .speed_m_s = 0.4, .points = {{1, 0, 0}}});
  rig.Run(8);
  ASSERT_EQ(rig.state().mode, DriveMode::kArrived);
  rig.drive().touch_watch().AddBumper(1, rig.now());
  rig.Run(1);
  EXPECT_EQ(rig.state().mode, DriveMode::kArrived);
  rig.SetPath({.id = 2, .speed_m_s = 0.4, .points = {{3, 0, 0}}});
  rig.Run(1);
  EXPECT_EQ(rig.state().mode, DriveMode::kFollowing) << "it has not arrived at the end of the new one";
  EXPECT_NEAR(rig.state().remaining_m, 2, 0.05);
  EXPECT_TRUE(rig.state().bumped);
  EXPECT_LT(rig.base().twist().vx, 1e-3);
  rig.drive().touch_watch().AddBumper(0, rig.now());
  rig.Run(4);
  EXPECT_GT(rig.base().twist().vx, 0.3);
}

TEST(DriveController, GivesTheSameCommandsForTheSameInputs) {
  const auto commands = [] {
    RobotRig rig(5, {0, 0.1, 0.05}, {}, {}, BoxSides(-1, -1.2, 7, 1.2));
    std::vector<WheelSpeeds> all;
    rig.SetPath(Straight());
    for (int i = 0; i < 300; ++i) {
      rig.Tick();
      if (rig.command()) all.push_back(*rig.command());
    }
    return all;
  };
  EXPECT_EQ(commands(), commands());
}

}  // namespace
}  // namespace priamos::robot
