#include "cli/scenario/door_name.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>

#include "common/archive.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

GroundPlan TwoDoors() {
  GroundPlan plan;
  plan.doors.resize(2);
  plan.doors[0].id = 7;
  plan.doors[0].name = "laboratory";
  plan.doors[1].id = 12;
  plan.doors[1].name = "31";
  return plan;
}

std::string Refusal(const GroundPlan& plan, const std::string& name) {
  try {
    DoorNamed(plan, name, "hall.toml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(DoorName, ANameIsThatOfTheMap) {
  EXPECT_EQ(DoorNamed(TwoDoors(), "laboratory", "hall.toml"), 7);
}

TEST(DoorName, ANameOfDigitsWinsOverTheNumber) {
  EXPECT_EQ(DoorNamed(TwoDoors(), "31", "hall.toml"), 12);
}

RC_GTEST_PROP(DoorName, ANumberNeedNotBeInThisMap, ()) {
  const int id = *rc::gen::inRange(1, 1000);
  RC_PRE(id != 31);
  RC_ASSERT(DoorNamed(TwoDoors(), fmt::format("{}", id), "hall.toml") == id);
}

TEST(DoorName, AnUnknownOneIsRefusedWithTheNearestAndWithAllOfTheMap) {
  EXPECT_EQ(Refusal(TwoDoors(), "labratory"),
            "unknown door \"labratory\"; nearest: \"laboratory\"; hall.toml has laboratory, 31");
}

TEST(DoorName, WhatIsNoNumberFromOneTo999IsRefused) {
  for (const char* name : {"", "0", "1000", "-1", "+5", "5a", " 5", "5.0", "99999999999999999999"})
    EXPECT_NE(Refusal(TwoDoors(), name), "") << '"' << name << '"';
}

TEST(DoorName, AMapWithoutDoorsSaysSo) {
  EXPECT_EQ(Refusal({}, "laboratory"), "unknown door \"laboratory\"; hall.toml has none");
}

TEST(DoorName, OfAPlannerIsThatOfItsMap) {
  const TemporaryFolder folder;
  std::ofstream(folder / "planner.toml") << "map = \"maps/hall.toml\"\n";
  try {
    DoorOfPlanner({folder / "planner.toml", {}}, "laboratory");
    FAIL() << "there is no such map";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr((folder / "maps/hall.toml").string()));
  }
}

}  // namespace
}  // namespace priamos::cli
