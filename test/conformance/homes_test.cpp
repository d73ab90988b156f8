#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "small_house.hpp"
#include "source_tree.hpp"
#include "test/support/project_files.hpp"

// Every source has a home: a source of the product lies where CMake looks for it, and a test lies at the path
// of what it tests.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Tests that several units or a document need together, without ".cpp"; and why none is their home.
const std::map<std::string, std::string> kWithoutUnit{
    {"test/planner/core/missions/elevator_test", "the door mission into a cabin and out of it"},
    {"test/planner/core/path/cabin_test", "door_planner and door_router at a cabin"},
    {"test/bus/claim_property_test", "properties of bus/claim"},
    {"test/bus/inbox_property_test", "properties of bus/inbox"},
    {"test/bus/python/python_bus_test", "what is written in Python beside C++"},
    {"test/bus/radio/packet/packet_radio_test", "both ends over packets against their budget"},
    {"test/bus/radio/command_freshness_test", "age of a command over both ends"},
    {"test/bus/radio/explorer/exploration_test", "the explorer of small worlds is itself a tool of tests"},
    {"test/bus/radio/explorer/power_loss_test", "an accident of both ends"},
    {"test/bus/radio/hello_replay_test", "an attack on both ends"},
    {"test/bus/radio/link_fork_test", "accidents of bus/radio/link"},
    {"test/bus/radio/golden/link_golden_test", "recorded bytes of bus/radio/link"},
    {"test/bus/radio/link_measurements_test", "figures of bus/radio/link"},
    {"test/bus/radio/link_stress_test", "random runs of bus/radio/link"},
    {"test/bus/radio/protocol_vectors_test", "the vectors of the protocol's document"},
    {"test/bus/radio/rekey_test", "a change of the key between both ends"},
    {"test/bus/radio/shared/station_slots_test", "whose turn it is, over all ends of one channel"},
    {"test/bus/radio/shared/station_test", "several robots and their station on one channel"},
    {"test/bus/radio/stop_on_bad_line_test", "an accident of both ends"},
    {"test/bus/radio/tiny/tiny_end_test", "the end in C beside one in C++"},
    {"test/bus/radio/tiny/tiny_frame_test", "the end in C against the vectors of the protocol's document"},
    {"test/bus/radio/tiny/tiny_hostile_test", "the end in C on a line on which somebody sits"},
    {"test/bus/radio/tiny/tiny_size_test", "the end in C as a microcontroller has it"},
    {"test/bus/schema/mutation_test", "damaged bytes in every decoder of the room"},
    {"test/cli/laser_in_the_world_test", "head and world together"},
    {"test/cli/shipped_configs_test", "every file of config/"},
    {"test/cli/verbs/log/foreign_folder_test", "all verbs of the room with the types of other robots"},
    {"test/cli/verbs/log/foreign_log_test", "all verbs of the room on logs of other robots"},
    {"test/head/landmark_models_test", "planner's landmarks in the head's hands"},
    {"test/head/live_parameters_test", "every parameter that head_config marks as live"},
    {"test/head/narrow_door_test", "pictures of a run, by the shipped configuration"},
    {"test/head/real_photographs_test", "the whole of seeing on photographs"},
    {"test/planner/core/locate/no_wrong_place_test", "the whole room in buildings made up"},
    {"test/planner/core/missions/door_blocked_test", "the door mission where its way is closed"},
    {"test/planner/core/missions/door_looks_test", "the looks of the door mission"},
    {"test/planner/live_parameters_test", "every parameter that planner_config marks as live"},
    {"test/planner/second_mission_test", "a mission that is not shipped"},
    {"test/radio/command_freshness_test", "age of a command through the process"},
    {"test/radio/foreign_types_test", "types that were never compiled in, through the process"},
    {"test/radio/link_config_test", "the link tables of config/ against the channels"},
    {"test/radio/link_refusals_test", "every refusal of a link table and of its budget"},
    {"test/radio/radio_start_test", "every refusal of the process's configuration"},
    {"test/radio/rekey_test", "a change of the key through the process"},
    {"test/radio/robots_config_test", "what the files of several robots say together"},
    {"test/radio/unknown_states_test", "codes of no known state, through the process"},
    {"test/robot/core/motion/corridor_run_test", "the whole room between walls"},
    {"test/robot/core/motion/detour_run_test", "the whole room around boxes"},
    {"test/robot/core/motion/door_run_test", "the whole room in one run"},
    {"test/robot/core/motion/mover_run_test", "the whole room before somebody who comes"},
    {"test/robot/core/motion/slant_run_test", "the whole room along walls and through openings at a slant"},
    {"test/robot/core/motion/shared_control_test", "the whole room under an operator"},
    {"test/robot/core/pose/pose_consistency_test", "statistics of the whole room"},
    {"test/robot/core/sonar/blind_gaps_test", "the whole room between two beams"},
    {"test/robot/live_parameters_test", "every parameter that robot_config marks as live"},
    {"test/robot/robot_operator_test", "the process under an operator"},
    {"test/robot/robot_readme_test", "the README of the module"},
    {"test/robot/robot_restart_test", "the process started again"},
};

/// Folders of test/ that mirror nothing.
const std::set<std::string> kOwnFolders{"system", "replay", "conformance", "fuzz", "bench", "support"};

std::string FirstFolder(const std::string& below) {
  return below.substr(0, below.find('/'));
}

bool HasUnit(const fs::path& root, const std::string& unit) {
  for (const char* from : {"", "modules"})
    for (const char* extension : {".hpp", ".cpp"})
      if (fs::exists(root / from / (unit + extension))) return true;
  return false;
}

/// Tests whose path names no unit and that are not listed; entries of the list that nothing needs.
std::vector<std::string> TestsWithoutUnit(const fs::path& root, const std::vector<fs::path>& files,
                                          const std::map<std::string, std::string>& listed) {
  static const std::regex kTest("test/((.*)_test)\\.cpp");
  std::vector<std::string> found;
  std::set<std::string> unused;
  for (const auto& entry : listed) unused.insert(entry.first);
  for (const fs::path& file : files) {
    std::smatch m;
    const std::string name = file.string();
    if (!std::regex_match(name, m, kTest) || kOwnFolders.contains(FirstFolder(m[1])) || HasUnit(root, m[2]))
      continue;
    if (unused.erase("test/" + m[1].str()) == 0)
      found.push_back(
          fmt::format("{}: there is no unit {}; next: name it as the unit that it tests, or list it "
                      "with its reason in test/conformance/homes_test.cpp",
                      name, m[2].str()));
  }
  for (const std::string& name : unused)
    found.push_back(name + ": needs no reason; next: take it from test/conformance/homes_test.cpp");
  return found;
}

/// Tests in folders that no priamos_test builds.
std::vector<std::string> UnbuiltTests(const fs::path& root, const std::vector<fs::path>& files) {
  const std::string lists = TextOf(root / "test/CMakeLists.txt");
  std::set<std::string> found;
  for (const fs::path& file : files) {
    const std::string name = file.string();
    if (!name.starts_with("test/") || !name.ends_with("_test.cpp")) continue;
    const std::string folder = FirstFolder(name.substr(5));
    if (!std::regex_search(lists, std::regex("(?:^|\n)priamos_test\\(" + folder + "[ )]")))
      found.insert(fmt::format(
          "{}: nothing builds it; next: add priamos_test({} LIBS ...) to test/CMakeLists.txt", name, folder));
  }
  return {found.begin(), found.end()};
}

/// Why a source of C++ lies or is named where nothing builds it; empty when it is at home.
std::string Homeless(const std::string& file) {
  static const std::regex kSource(R"(.*\.(?:[hc]pp|[ht]?cc|hh?|c|[ch]xx|[it]pp|inl|ixx|C|H))");
  static const std::regex kName(R"((?:.*/)?[a-z][a-z0-9_]*\.[hc]pp)");
  static const std::regex kHome(R"((?:lcmtypes|bus|test|modules/[a-z0-9_]+)/.*)");
  if (!std::regex_match(file, kSource) || IsStandalone(fs::path(file).parent_path())) return "";
  if (!std::regex_match(file, kName)) return "expected a name like small_words.cpp or .hpp; next: rename it";
  if (!std::regex_match(file, kHome))
    return "no library builds it; next: move it into bus/, modules/ or test/";
  return "";
}

std::vector<std::string> HomelessSources(const std::vector<fs::path>& files) {
  std::vector<std::string> found;
  for (const fs::path& file : files)
    if (const std::string why = Homeless(file.string()); !why.empty())
      found.push_back(file.string() + ": " + why);
  return found;
}

/// Headers beside the rooms of a core that has no .cpp: its library is only the sum of its rooms.
std::vector<std::string> StraysBesideRooms(const fs::path& root, const std::vector<fs::path>& files) {
  static const std::regex kInCore(R"((modules/\w+/core)/[^/]+\.[hc]pp)");
  std::vector<std::string> found;
  for (const fs::path& file : files) {
    std::smatch m;
    const std::string name = file.string();
    if (!std::regex_match(name, m, kInCore)) continue;
    const std::string folder = m[1];
    const bool compiles = std::any_of(files.begin(), files.end(), [&](const fs::path& other) {
      return other.parent_path() == folder && other.extension() == ".cpp";
    });
    if (!compiles && TextOf(root / folder / "CMakeLists.txt").find("add_subdirectory(") != std::string::npos)
      found.push_back(name + ": lies beside the rooms of its core; next: move it into one of them");
  }
  return found;
}

TEST(Homes, EveryTestNamesItsUnit) {
  EXPECT_THAT(TestsWithoutUnit(PRIAMOS_SOURCE_DIR, ProjectFiles("test"), kWithoutUnit), IsEmpty());
}

TEST(Homes, EveryTestIsBuilt) {
  EXPECT_THAT(UnbuiltTests(PRIAMOS_SOURCE_DIR, ProjectFiles("test")), IsEmpty());
}

TEST(Homes, EverySourceIsWhereSomethingBuildsIt) {
  EXPECT_GT(ProjectFiles().size(), 800u);
  EXPECT_THAT(HomelessSources(ProjectFiles()), IsEmpty());
}

TEST(Homes, NoSourceLiesBesideTheRoomsOfACore) {
  EXPECT_THAT(StraysBesideRooms(PRIAMOS_SOURCE_DIR, ProjectFiles("modules")), IsEmpty());
}

TEST(Homes, SourcesThatNothingBuildsAreFound) {
  for (const char* file :
       {"config/x.hpp", "scripts/x.cpp", "bus/Capital.cpp", "bus/x.ipp", "bus/1.cpp", "x.hpp"})
    EXPECT_THAT(HomelessSources({file}), ElementsAre(HasSubstr("; next: "))) << file;
  EXPECT_THAT(HomelessSources({"bus/x.hpp", "modules/robot/main.cpp", "modules/cli/spy/A.java", "README.md"}),
              IsEmpty());
}

using HomesOfSmallHouse = SmallHouse;

TEST_F(HomesOfSmallHouse, ATestWithoutUnitIsFound) {
  const std::vector<fs::path> files{"test/bus/low/a_test.cpp", "test/robot/d_test.cpp", "test/bus/a_test.cpp",
                                    "test/system/any_test.cpp"};
  EXPECT_THAT(TestsWithoutUnit(root(), files, {}),
              ElementsAre(HasSubstr("test/bus/a_test.cpp: there is no unit bus/a; next: ")));
  EXPECT_THAT(TestsWithoutUnit(root(), files, {{"test/bus/a_test", "why"}}), IsEmpty());
  EXPECT_THAT(TestsWithoutUnit(root(), {}, {{"test/bus/a_test", "why"}}),
              ElementsAre(HasSubstr("test/bus/a_test: needs no reason; next: ")));
}

TEST_F(HomesOfSmallHouse, ATestThatNobodyBuildsIsFound) {
  Put("test/CMakeLists.txt", "priamos_test(bus LIBS bus)\n# priamos_test(robot LIBS robot_app)\n");
  EXPECT_THAT(UnbuiltTests(root(), {"test/bus/low/a_test.cpp", "test/robot/d_test.cpp"}),
              ElementsAre(HasSubstr("test/robot/d_test.cpp: nothing builds it; next: ")));
}

TEST_F(HomesOfSmallHouse, ASourceBesideTheRoomsOfACoreIsFound) {
  Put("modules/robot/core/CMakeLists.txt", "add_subdirectory(base)\n");
  Put("modules/teleop/core/CMakeLists.txt", "priamos_library(teleop_core)\n");
  Put("modules/world/core/CMakeLists.txt", "add_subdirectory(base)\npriamos_library(world_core)\n");
  EXPECT_THAT(StraysBesideRooms(root(), {"modules/robot/core/stray.hpp", "modules/robot/core/base/a.hpp",
                                         "modules/teleop/core/b.hpp", "modules/world/core/c.cpp",
                                         "modules/world/core/c.hpp"}),
              ElementsAre(HasSubstr("modules/robot/core/stray.hpp: lies beside the rooms")));
}

}  // namespace
}  // namespace priamos
