#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "small_house.hpp"
#include "source_tree.hpp"

// The rooms of the house. Read from the top, the CMakeLists.txt files name them from the ground up: a folder
// includes only what is named before it, and a parent comes after its rooms.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kMostUnits = 25;  ///< sources of a folder; a header and its .cpp count once

/// Includes that start neither at the root nor at modules/ (a header beside the source, a path with ".."): no
/// rule would see where they lead.
std::vector<std::string> UnrootedIncludes(const fs::path& root) {
  std::vector<std::string> found;
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"}))
    for (const std::string& header : QuotedIncludes(TextOf(root / source)))
      if (FolderOf(root, header).empty())
        found.push_back(
            fmt::format("{}: {}: expected a path from the root or from modules/", source.string(), header));
  return found;
}

/// Includes that run up, and folders that no CMakeLists.txt names.
std::vector<std::string> ArrowsUp(const fs::path& root) {
  const std::vector<std::string> order = FolderOrder(root);
  std::vector<std::string> found;
  const auto place = [&](const std::string& folder) { return std::find(order.begin(), order.end(), folder); };
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"})) {
    const std::string from = source.parent_path().string();
    if (place(from) == order.end())
      found.push_back(fmt::format("{}: no add_subdirectory names its folder", source.string()));
    for (const std::string& header : QuotedIncludes(TextOf(root / source))) {
      const std::string to = FolderOf(root, header);
      if (!to.empty() && to != from && place(to) >= place(from))
        found.push_back(
            fmt::format("{}: must not include {}, whose folder is named later", source.string(), header));
    }
  }
  return found;
}

std::vector<std::string> FullFolders(const fs::path& root) {
  std::map<std::string, std::set<std::string>> units;
  for (const fs::path& source : SourcesIn(root, {"bus", "modules", "test"}))
    units[source.parent_path().string()].insert(source.stem().string());
  std::vector<std::string> found;
  for (const auto& [folder, names] : units)
    if (names.size() > kMostUnits) found.push_back(fmt::format("{}: {} units", folder, names.size()));
  return found;
}

/// Units that each unit includes; a unit is a header and its .cpp, named without extension.
std::map<std::string, std::set<std::string>> UnitGraph(const fs::path& root) {
  std::map<std::string, std::set<std::string>> graph;
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"})) {
    auto& included = graph[fs::path(source).replace_extension().string()];
    for (const std::string& header : QuotedIncludes(TextOf(root / source))) {
      const std::string folder = FolderOf(root, header);
      if (!folder.empty()) included.insert(folder + "/" + fs::path(header).stem().string());
    }
  }
  return graph;
}

void Reach(const std::map<std::string, std::set<std::string>>& graph, const std::string& from,
           std::set<std::string>& reached) {
  if (const auto unit = graph.find(from); unit != graph.end())
    for (const std::string& next : unit->second)
      if (reached.insert(next).second) Reach(graph, next, reached);
}

/// Pairs of units that include each other, directly or through others: neither can be read alone.
std::vector<std::string> Circles(const fs::path& root) {
  const auto graph = UnitGraph(root);
  std::map<std::string, std::set<std::string>> reached;
  for (const auto& [unit, included] : graph)
    for (const std::string& next : included)
      if (next != unit && reached[unit].insert(next).second) Reach(graph, next, reached[unit]);
  std::vector<std::string> found;
  for (const auto& [unit, others] : reached)
    for (const std::string& other : others)
      if (unit < other && reached[other].contains(unit)) found.push_back(unit + " and " + other);
  return found;
}

/// Whether the first line of a file says something: a comment or title of two words or more, and no reminder.
bool SaysSomething(const fs::path& file) {
  static const std::regex kLine("# [^ ]+ [^]*"), kReminder(R"(\b(TODO|FIXME|XXX)\b)");
  const std::string text = TextOf(file), line = text.substr(0, text.find('\n'));
  return std::regex_match(line, kLine) && !std::regex_search(line, kReminder);
}

/// Folders of which neither a README.md nor the first line of CMakeLists.txt says what lives there.
std::vector<std::string> SilentFolders(const fs::path& root) {
  std::set<std::string> folders;
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"}))
    folders.insert(source.parent_path().string());
  std::vector<std::string> found;
  for (const std::string& folder : folders) {
    if (!SaysSomething(root / folder / "README.md") && !SaysSomething(root / folder / "CMakeLists.txt"))
      found.push_back(folder);
  }
  return found;
}

TEST(RoomRules, NoIncludeRunsUp) {
  EXPECT_GT(SourcesIn(PRIAMOS_SOURCE_DIR, {"bus", "modules"}).size(), 300u);
  EXPECT_THAT(ArrowsUp(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, EveryIncludeStartsAtTheRootOrAtModules) {
  EXPECT_THAT(UnrootedIncludes(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, NoTwoUnitsIncludeEachOther) {
  EXPECT_THAT(Circles(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, TheRoomForOtherProjectsIncludesNothingElse) {
  const fs::path folder = fs::path(PRIAMOS_SOURCE_DIR) / kStandalone;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".c" && entry.path().extension() != ".h") continue;
    ++files;
    for (const std::string& header : QuotedIncludes(TextOf(entry.path())))
      EXPECT_TRUE(fs::path(header).parent_path().empty() && fs::exists(folder / header)) << entry << header;
  }
  EXPECT_GT(files, 10U);
}

TEST(RoomRules, NoFolderIsCrowded) {
  EXPECT_THAT(FullFolders(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, EveryFolderSaysWhatLivesThere) {
  EXPECT_THAT(SilentFolders(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST_F(SmallHouse, StandsWhenArrowsRunDown) {
  EXPECT_THAT(ArrowsUp(root()), IsEmpty());
}

TEST_F(SmallHouse, AnArrowBetweenRoomsThatRunsUpIsFound) {
  Put("bus/low/a.hpp", "#include \"bus/high/b.hpp\"\n");
  EXPECT_THAT(ArrowsUp(root()), ElementsAre(HasSubstr("bus/low/a.hpp: must not include bus/high/b.hpp")));
}

TEST_F(SmallHouse, AnIncludeByAWayUpIsFound) {
  Put("bus/low/a.hpp", "#include \"../high/b.hpp\"\n#include \"bus/low/../high/b.hpp\"\n");
  EXPECT_THAT(UnrootedIncludes(root()), ElementsAre(HasSubstr("bus/low/a.hpp: ../high/b.hpp"),
                                                    HasSubstr("bus/low/a.hpp: bus/low/../high/b.hpp")));
}

TEST_F(SmallHouse, AnIncludeFromBesideIsFound) {
  Put("bus/low/f.hpp", "#include \"a.hpp\"\n");
  EXPECT_THAT(UnrootedIncludes(root()), ElementsAre(HasSubstr("bus/low/f.hpp: a.hpp")));
}

TEST_F(SmallHouse, ARoomDoesNotIncludeItsParent) {
  Put("bus/low/a.cpp", "#include \"bus/c.hpp\"\n");
  EXPECT_THAT(ArrowsUp(root()), ElementsAre(HasSubstr("bus/low/a.cpp: must not include bus/c.hpp")));
}

TEST_F(SmallHouse, AnArrowIntoAModuleIsFoundByItsShortName) {
  Put("bus/c.hpp", "#include \"robot/d.hpp\"\n");
  EXPECT_THAT(ArrowsUp(root()), ElementsAre(HasSubstr("bus/c.hpp: must not include robot/d.hpp")));
}

TEST_F(SmallHouse, AFolderThatNobodyNamesIsFound) {
  Put("bus/new/e.hpp", "");
  EXPECT_THAT(ArrowsUp(root()), ElementsAre(HasSubstr("bus/new/e.hpp: no add_subdirectory")));
}

TEST_F(SmallHouse, ACircleOfUnitsIsFound) {
  Put("bus/low/a.cpp", "#include \"bus/low/a.hpp\"\n#include \"bus/low/f.hpp\"\n");
  Put("bus/low/g.hpp", "");
  Put("bus/low/f.hpp", "#include \"bus/low/g.hpp\"\n");
  EXPECT_THAT(Circles(root()), IsEmpty());
  Put("bus/low/g.cpp", "#include \"bus/low/a.hpp\"\n");
  EXPECT_THAT(Circles(root()),
              ElementsAre("bus/low/a and bus/low/f", "bus/low/a and bus/low/g", "bus/low/f and bus/low/g"));
}

TEST_F(SmallHouse, ACrowdedFolderIsFound) {
  for (int i = 0; i < 24; ++i) Put(fmt::format("bus/low/unit_{}.cpp", i), "");
  Put("bus/low/a.cpp", "");
  EXPECT_THAT(FullFolders(root()), IsEmpty());
  Put("bus/low/one_more.hpp", "");
  EXPECT_THAT(FullFolders(root()), ElementsAre("bus/low: 26 units"));
}

TEST_F(SmallHouse, AFolderCrowdedWithOtherLanguagesIsFound) {
  for (int i = 0; i < 13; ++i) {
    Put(fmt::format("bus/high/unit_{}.cc", i), "");
    Put(fmt::format("bus/high/Unit{}.java", i), "");
  }
  EXPECT_THAT(FullFolders(root()), ElementsAre("bus/high: 27 units"));
}

TEST_F(SmallHouse, AFolderThatDoesNotSayWhatLivesThereIsFound) {
  Put("bus/low/CMakeLists.txt", "# What is below.\n");
  Put("bus/high/README.md", "# high: what is above\n");
  Put("lcmtypes/channels.hpp", "");
  Put("lcmtypes/CMakeLists.txt", "# TODO say it\n");
  Put("bus/CMakeLists.txt", "# Wire\n");
  EXPECT_THAT(SilentFolders(root()), ElementsAre("bus", "lcmtypes", "modules/robot"));
}

}  // namespace
}  // namespace priamos
