#include "cli/scenario/scenario.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string Refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

Scenario Parsed(const std::string& text) {
  return ParseConfig<Scenario>("walk.toml", text);
}

class ScenarioFolder : public testing::Test {
 protected:
  ScenarioFolder() {
    std::filesystem::create_directory(folder_ / "scenarios");
    for (const char* name : {"walk.toml", "door.toml", "notes.txt"})
      std::ofstream(folder_ / "scenarios" / name) << "title = \"" << name << "\"\n";
  }
  TemporaryFolder folder_;
};

TEST_F(ScenarioFolder, AScenarioIsLoadedByItsName) {
  EXPECT_EQ(LoadScenario(folder_.path(), "walk").title, "walk.toml");
}

TEST_F(ScenarioFolder, AnUnknownOneIsAnsweredWithTheKnownOnesInOrder) {
  EXPECT_EQ(Refusal([&] { LoadScenario(folder_.path(), "dor"); }),
            (folder_ / "scenarios").string() +
                ": expected a scenario (door, walk), got \"dor\"; nearest: \"door\"");
}

TEST_F(ScenarioFolder, NoNameLeadsOutOfTheFolder) {
  std::ofstream(folder_ / "outside.toml") << "title = \"outside\"\n";
  EXPECT_THAT(Refusal([&] { LoadScenario(folder_.path(), "../outside"); }), HasSubstr("got \"../outside\""));
}

TEST_F(ScenarioFolder, AFolderWithoutScenariosNamesTheDeploymentsThatHaveSome) {
  EXPECT_EQ(
      Refusal([] { LoadScenario("/no/such/folder", "door"); }),
      "scenario: expected one of the deployment /no/such/folder, got \"door\": it has no scenarios; next: "
      "--deployment sim, which has some");
}

TEST_F(ScenarioFolder, TheMapIsThatOfTheDeployment) {
  Scenario scenario;
  scenario.map = "maps/door.toml";
  EXPECT_EQ(MapFile("config/sim", scenario), "config/sim/maps/door.toml");
}

TEST(ScenarioFile, WhatIsLeftOutKeepsItsDefault) {
  const Scenario dut = Parsed("title = \"nothing\"\n"), none;
  EXPECT_EQ(dut.story, none.story);
  EXPECT_EQ(dut.landmark_id, none.landmark_id);
  EXPECT_EQ(dut.time_limit_s, none.time_limit_s);
  EXPECT_TRUE(dut.processes.empty());
  EXPECT_FALSE(dut.fast);
}

TEST(ScenarioFile, ProcessesAndWaypointsKeepTheirOrder) {
  const Scenario dut = Parsed(
      "[[process]]\nmodule = \"world\"\nbus = \"onboard\"\nconfig = \"world.toml\"\n"
      "[[process]]\nmodule = \"planner\"\nbus = \"offboard\"\nconfig = \"radio.toml\"\nset = "
      "\"side=offboard\"\n"
      "[[waypoint]]\nx_m = 1.5\ny_m = 0\n[[waypoint]]\nx_m = 0\ny_m = -2.0\nyaw_deg = 90.0\n");
  ASSERT_EQ(dut.processes.size(), 2u);
  EXPECT_EQ(dut.processes[0].module, "world");
  EXPECT_EQ(dut.processes[1].bus, "offboard");
  EXPECT_EQ(dut.processes[1].set, "side=offboard");
  ASSERT_EQ(dut.waypoints.size(), 2u);
  EXPECT_EQ(dut.waypoints[0].x_m, 1.5);
  EXPECT_EQ(dut.waypoints[1].yaw_deg, 90);
}

TEST(ScenarioFile, ValuesOutsideTheirBoundsAreRefusedWithLineAndKey) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"landmark_id = 1000\n", "walk.toml:1:landmark_id"},
      {"landmark_id = -1\n", "walk.toml:1:landmark_id"},
      {"time_limit_s = 0.5\n", "walk.toml:1:time_limit_s"},
      {"astray_deg = 91\n", "walk.toml:1:astray_deg"},
      {"shake_s = 0\n", "walk.toml:1:shake_s"},
      {"longest_stop_s = -1\n", "longest_stop_s"},
      {"least_seen = 1.1\n", "least_seen"},
      {"[[process]]\nmodule = \"wheels\"\n", "module"},
      {"[[process]]\nbus = \"yellow\"\n", "bus"},
      {"[[process]]\nwatchdog_s = 0.4\n", "watchdog_s"},
      {"[[waypoint]]\nx_m = 0\ny_m = 0\nyaw_deg = 181\n", "yaw_deg"}};
  for (const auto& [text, place] : wrong)
    EXPECT_THAT(Refusal([&] { Parsed(text); }), HasSubstr(place)) << text;
}

std::string Process(const std::string& module, const std::string& bus) {
  return "[[process]]\nmodule = \"" + module + "\"\nbus = \"" + bus + "\"\nconfig = \"x.toml\"\n";
}

TEST(ScenarioFile, TwoProcessesOfOneRoleAreRefused) {
  const std::string planner = Process("planner", "offboard"),
                    radios = Process("radio", "onboard") + Process("radio", "offboard");
  EXPECT_EQ(Refusal([&] { Parsed(planner + radios); }), "") << "a radio on each bus";
  EXPECT_THAT(
      Refusal([&] { Parsed(planner + Process("robot", "onboard") + Process("robot", "onboard")); }),
      AllOf(HasSubstr("walk.toml:1:process: expected each module once on a bus, and robot only once on "
                      "onboard")));
}

TEST(ScenarioFile, AStoryWithoutItsPlannerIsRefused) {
  const std::string robot = Process("robot", "onboard");
  const std::string expected = "process: expected a planner on the bus offboard, which the story ";
  EXPECT_THAT(Refusal([&] { Parsed(robot); }), HasSubstr(expected + "door gives its orders to"));
  EXPECT_THAT(Refusal([&] { Parsed("story = \"locate\"\n" + robot + Process("planner", "onboard")); }),
              HasSubstr(expected + "locate"));
  EXPECT_EQ(Refusal([&] { Parsed("story = \"teleop\"\n" + robot); }), "");
}

TEST(ScenarioFile, AStoryOfPlacesNeedsOneWithItsCoordinates) {
  for (const std::string story : {"goto", "patrol", "corridor"}) {
    const std::string head = "story = \"" + story + "\"\n";
    EXPECT_THAT(Refusal([&] { Parsed(head); }),
                HasSubstr("waypoint: expected [[waypoint]] with x_m and y_m"));
    EXPECT_EQ(Refusal([&] { Parsed(head + "[[waypoint]]\nx_m = 1\ny_m = 2\n"); }), "");
    EXPECT_THAT(Refusal([&] { Parsed(head + "[[waypoint]]\nx_m = 1\n"); }),
                HasSubstr("y_m: expected a place on the map in m, got none"));
  }
}

TEST(ScenarioFile, AnUnknownKeyIsNamed) {
  EXPECT_THAT(Refusal([] { Parsed("titel = \"x\"\n"); }),
              AllOf(HasSubstr("walk.toml:1"), HasSubstr("titel")));
}

}  // namespace
}  // namespace priamos::cli
