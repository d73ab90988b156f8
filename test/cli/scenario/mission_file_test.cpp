#include "cli/scenario/mission_file.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/config.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kMap = PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml";

mission_command_t Read(const std::string& text) {
  ConfigFile toml("round.toml", text);
  MissionFile file;
  file.Describe(toml.archive());
  toml.RefuseUnknownKeys();
  return OrderOf(file, {}, LoadConfig<GroundPlan>(kMap), "door.toml");
}

std::string WhyNot(const std::string& text) {
  try {
    Read(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

const std::string kGo = "[[step]]\ndo = \"goto\"\nx_m = 4.0\ny_m = 2.4\n";

TEST(MissionFile, ItsStepsBecomeAnOrder) {
  const auto order = Read("title = \"round\"\nrounds = 0\n" + kGo +
                          "yaw_deg = 90\n[[step]]\ndo = \"wait\"\nwait_s = 5\n[[step]]\ndo = \"door\"\n"
                          "door = \"laboratory\"\n[[step]]\ndo = \"goto\"\nx_m = 8.0\ny_m = 1.5\n");
  EXPECT_EQ(order.mission, mission_command_t::RUN);
  EXPECT_EQ(order.title, "round");
  EXPECT_EQ(order.rounds, 0);
  ASSERT_EQ(order.n_steps, 4);
  EXPECT_EQ(order.steps[0].mission, mission_command_t::GOTO);
  EXPECT_TRUE(order.steps[0].turn);
  EXPECT_NEAR(order.steps[0].yaw_rad, kPi / 2, 1e-9);
  EXPECT_EQ(order.steps[1].mission, mission_command_t::WAIT);
  EXPECT_EQ(order.steps[1].wait_s, 5);
  EXPECT_EQ(order.steps[2].landmark_id, 1);
  EXPECT_FALSE(order.steps[3].turn);
}

mission_command_t Ride(const std::string& more, double width_m = 1.10) {
  GroundPlan plan = LoadConfig<GroundPlan>(PRIAMOS_SOURCE_DIR "/config/sim/maps/elevator.toml");
  for (WallPlan& wall : plan.walls) {
    if (wall.name == "cabin right") wall.from_m[1] = wall.to_m[1] = 2.4 - width_m / 2 - 0.07;
    if (wall.name == "cabin left") wall.from_m[1] = wall.to_m[1] = 2.4 + width_m / 2 + 0.07;
    if (wall.name == "cabin back") wall.from_m[0] = wall.to_m[0] = 6.14 + std::max(1.40, width_m);
  }
  ConfigFile toml("ride.toml", "[[step]]\ndo = \"elevator\"\ndoor = \"cabin\"\nwait_s = 20\n" + more);
  MissionFile file;
  file.Describe(toml.archive());
  toml.RefuseUnknownKeys();
  return OrderOf(file, {}, plan, "elevator.toml");
}

TEST(MissionFile, AnElevatorIsADoorARideAndTheDoorAgain) {
  const auto order = Ride(kGo);
  ASSERT_EQ(order.n_steps, 4);
  EXPECT_EQ(order.steps[0].mission, mission_command_t::PASS_DOOR);
  EXPECT_EQ(order.steps[1].mission, mission_command_t::WAIT);
  EXPECT_EQ(order.steps[1].wait_s, 20);
  EXPECT_EQ(order.steps[2].mission, mission_command_t::PASS_DOOR);
  EXPECT_EQ(order.steps[2].landmark_id, 1);
}

TEST(MissionFile, WhereTheCabinIsWideEnoughItMayTurnInIt) {
  const auto order = Ride("turn = true\n", 1.6);
  ASSERT_EQ(order.n_steps, 4);
  EXPECT_EQ(order.steps[1].mission, mission_command_t::GOTO);
  EXPECT_NEAR(std::abs(order.steps[1].yaw_rad), kPi, 1e-9);
  EXPECT_NEAR(order.steps[1].x_m, 6.87, 0.02);
  try {
    Ride("turn = true\n");
    FAIL() << "the circle around the base is 1.23 m";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), StartsWith("ride.toml:1:"));
  }
}

TEST(MissionFile, AnElevatorWithoutACabinIsRefused) {
  EXPECT_THAT(WhyNot("[[step]]\ndo = \"elevator\"\ndoor = \"laboratory\"\n"),
              testing::AllOf(StartsWith("round.toml:1:"), HasSubstr("leads into no cabin")));
}

TEST(MissionFile, ARepeatIsWrittenOut) {
  const auto order = Read(kGo +
                          "[[step]]\ndo = \"wait\"\nwait_s = 1\n[[step]]\ndo = \"repeat\"\nfrom = 2\n"
                          "times = 3\n" +
                          kGo);
  ASSERT_EQ(order.n_steps, 6);
  EXPECT_EQ(order.steps[4].mission, mission_command_t::WAIT);
  EXPECT_EQ(order.steps[5].mission, mission_command_t::GOTO);
}

TEST(MissionFile, WhatCannotBeDoneIsNamedWithItsLine) {
  EXPECT_THAT(WhyNot(kGo + "[[step]]\ndo = \"door\"\ndoor = \"labratory\"\n"),
              StartsWith("round.toml:5: unknown door \"labratory\"; nearest: \"laboratory\""));
  EXPECT_THAT(WhyNot(kGo + "[[step]]\ndo = \"door\"\ndoor = \"9\"\n"), "round.toml:5: the map has no door 9");
  EXPECT_THAT(WhyNot("[[step]]\ndo = \"goto\"\nx_m = 6.0\ny_m = 1.0\n"),
              AllOf(StartsWith("round.toml:1: "), HasSubstr("wall 'right of the door'")));
  EXPECT_THAT(WhyNot("[[step]]\ndo = \"goto\"\nx_m = 4.0\n"),
              HasSubstr("round.toml:1:step[0].y_m: expected a place"));
  EXPECT_THAT(
      WhyNot("[[step]]\ndo = \"fly\"\n"),
      HasSubstr(
          "round.toml:2:step[0].do: expected one of goto, door, elevator, corridor, explore, locate, wait"));
  EXPECT_THAT(WhyNot(kGo + "wait_s = 4\n"), AllOf(StartsWith("round.toml:5:"), HasSubstr("wait_s")));
  EXPECT_THAT(WhyNot("[[step]]\ndo = \"repeat\"\nfrom = 1\n" + kGo), HasSubstr("a step before this one"));
  EXPECT_THAT(WhyNot(kGo + "[[step]]\ndo = \"repeat\"\ntimes = 32\n"), HasSubstr("at most 32 steps"));
  EXPECT_THAT(WhyNot("title = \"nothing\"\n"), HasSubstr("one or more [[step]]"));
}

TEST(MissionFile, ATitleHasNoControlCharacters) {
  for (const char* title : {"a\\u0000b", "a\\u001b[31mb", "a\\nb", "a\\u007fb"})
    EXPECT_THAT(WhyNot("title = \"" + std::string(title) + "\"\n" + kGo),
                HasSubstr("round.toml:1:title: expected text without control characters, got"))
        << title;
  EXPECT_EQ(Read("title = \"Tür zum Flur\"\n" + kGo).title, "Tür zum Flur");
}

/// The number is judged before the ways are planned: the first step stands in a wall.
TEST(MissionFile, TooManyStepsAreRefusedBeforeTheyAreRehearsed) {
  std::string text = "[[step]]\ndo = \"goto\"\nx_m = 6.0\ny_m = 1.0\n";
  for (int i = 0; i < 200; ++i) text += kGo;
  EXPECT_THAT(WhyNot(text), HasSubstr("expected at most 32 steps, got 201"));
}

TEST(MissionFile, TheShippedOneIsGood) {
  const auto order = OrderOfFile(PRIAMOS_SOURCE_DIR "/config/sim/missions/round.toml",
                                 {PRIAMOS_SOURCE_DIR "/config/sim/planner.toml", {}});
  EXPECT_EQ(order.n_steps, 4);
}

}  // namespace
}  // namespace priamos::cli
