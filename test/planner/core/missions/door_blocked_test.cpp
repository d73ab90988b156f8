#include <gmock/gmock.h>

#include "door_mission_story.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

LeafSighting Leaf(double open_deg) {
  return {Time{}, 1, "left", Radians(open_deg), Radians(0.7), 6};
}

TEST(DoorBlocked, ALeafInTheWayIsRefusedBeforeTheDoor) {
  DoorStory s;
  s.robot.leaf = Leaf(45);
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(s.dut.state().text,
            "door 'laboratory' stands open only 45 degrees: 0.24 m are free, 0.80 m needed");
  EXPECT_LT(s.robot.truth().x, 6 - 0.085 - 0.475 - 1);
}

TEST(DoorBlocked, ALeafThatLeavesTheWayFreeOrMayDoSoIsNoReasonToRefuse) {
  for (const double deg : {92.0, 84.0}) {
    DoorStory s;
    s.robot.leaf = Leaf(deg);
    s.Start();
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, Phase::kDone) << deg << ": " << s.dut.state().text;
  }
}

TEST(DoorBlocked, TheLeafOfAnotherDoorOrOfAnEarlierMissionIsNotThisOne) {
  for (LeafSighting other : {LeafSighting{FromUtime(1'020'000'000), 2, "left", Radians(45), 0.01, 9},
                             LeafSighting{FromUtime(999'000'000), 1, "left", Radians(45), 0.01, 9}}) {
    DoorStory s;
    s.Start();
    s.robot.RunUntil(Phase::kLookingRight);
    s.dut.OnLeaf(other);
    s.dut.OnLeaf(other);
    s.robot.RunFor(60);
    EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  }
}

TEST(DoorBlocked, AfterATouchItGoesBackAndEnds) {
  DoorStory s;
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

TEST(DoorBlocked, WhatStoodInTheDoorMayHaveGoneWhenItComesAgain) {
  DoorStory s;
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

TEST(DoorBlocked, BlockedTwiceInTheDoorItEndsBeforeIt) {
  DoorStory s;
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

TEST(DoorBlocked, BlockedBeforeAndBehindItStays) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunUntilX(5.7);
  s.robot.blocked = true;
  s.robot.RunFor(30);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("and on its way back the robot was blocked for 8 s"));
}

TEST(DoorBlocked, BlockedOnItsWayBackItLooksAgainFromThereWhenTheDoorwayIsFree) {
  DoorStory s;
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

TEST(DoorBlocked, BlockedOnTheWayItTriesAgainWhereItStands) {
  DoorStory s;
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

TEST(DoorBlocked, ShortBlockadeIsWaitedOut) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.RunFor(1);
  s.robot.blocked = true;
  s.robot.RunFor(4);
  s.robot.blocked = false;
  s.robot.RunFor(30);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

}  // namespace
}  // namespace priamos::planner
