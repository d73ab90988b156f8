#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "test/support/temporary_folder.hpp"

// The rooms of the house. Read from the top, the CMakeLists.txt files name them from the ground up: a folder
// includes only what is named before it, and a parent comes after its rooms.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kMostUnits = 25;  ///< sources of a folder; a header and its .cpp count once

std::string Read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Folders, relative to `root`, in the order in which the CMakeLists.txt files name them.
void AddInOrder(const fs::path& root, const fs::path& folder, std::vector<std::string>& order) {
  static const std::regex kNamed(R"(^\s*add_subdirectory\(([\w/]+)\))");
  std::ifstream file(root / folder / "CMakeLists.txt");
  for (std::string line; std::getline(file, line);) {
    std::smatch m;
    if (std::regex_search(line, m, kNamed)) AddInOrder(root, folder / m[1].str(), order);
  }
  order.push_back(folder.string());
}

std::vector<fs::path> SourcesIn(const fs::path& root, std::initializer_list<const char*> folders) {
  std::vector<fs::path> sources;
  for (const char* folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".hpp" || extension == ".cpp") sources.push_back(fs::relative(entry.path(), root));
    }
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

/// The folder of the tree that an include means; empty for generated and foreign headers.
std::string FolderOf(const fs::path& root, const std::string& header) {
  for (const char* from : {"", "modules"}) {
    if (fs::exists(root / from / header)) return (fs::path(from) / header).parent_path().string();
  }
  return "";
}

std::vector<std::string> QuotedIncludes(const std::string& text) {
  static const std::regex kInclude(R"re(#include\s+"([^"]+)")re");
  std::vector<std::string> headers;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), kInclude); it != std::sregex_iterator(); ++it)
    headers.push_back((*it)[1]);
  return headers;
}

/// Includes that run up, and folders that no CMakeLists.txt names.
std::vector<std::string> ArrowsUp(const fs::path& root) {
  std::vector<std::string> order, found;
  AddInOrder(root, "", order);
  const auto place = [&](const std::string& folder) { return std::find(order.begin(), order.end(), folder); };
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"})) {
    const std::string from = source.parent_path().string();
    if (place(from) == order.end())
      found.push_back(fmt::format("{}: no add_subdirectory names its folder", source.string()));
    for (const std::string& header : QuotedIncludes(Read(root / source))) {
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
    for (const std::string& header : QuotedIncludes(Read(root / source))) {
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

/// Folders of which neither a README.md nor the first line of CMakeLists.txt says what lives there.
std::vector<std::string> SilentFolders(const fs::path& root) {
  std::set<std::string> folders;
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"}))
    folders.insert(source.parent_path().string());
  std::vector<std::string> found;
  for (const std::string& folder : folders) {
    if (!Read(root / folder / "README.md").starts_with("# ") &&
        !Read(root / folder / "CMakeLists.txt").starts_with("# "))
      found.push_back(folder);
  }
  return found;
}

TEST(RoomRules, NoIncludeRunsUp) {
  EXPECT_GT(SourcesIn(PRIAMOS_SOURCE_DIR, {"bus", "modules"}).size(), 300u);
  EXPECT_THAT(ArrowsUp(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, NoTwoUnitsIncludeEachOther) {
  EXPECT_THAT(Circles(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, NoFolderIsCrowded) {
  EXPECT_THAT(FullFolders(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(RoomRules, EveryFolderSaysWhatLivesThere) {
  EXPECT_THAT(SilentFolders(PRIAMOS_SOURCE_DIR), IsEmpty());
}

/// A small house: bus/low, bus/high, bus, modules/robot.
class SmallHouse : public testing::Test {
 protected:
  SmallHouse() {
    Put("CMakeLists.txt", "add_subdirectory(bus)\nadd_subdirectory(modules/robot)\n");
    Put("bus/CMakeLists.txt", "# The wire.\nadd_subdirectory(low)  # below\nadd_subdirectory(high)\n");
    Put("bus/low/a.hpp", "");
    Put("bus/high/b.hpp", "#include \"bus/low/a.hpp\"\n");
    Put("bus/c.hpp", "#include \"bus/high/b.hpp\"\n");
    Put("modules/robot/d.hpp",
        "#include \"bus/c.hpp\"\n#include <vector>\n#include \"priamos/pose_t.hpp\"\n");
  }
  void Put(const fs::path& file, const std::string& text) {
    fs::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file) << text;
  }
  const fs::path& root() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(SmallHouse, StandsWhenArrowsRunDown) {
  EXPECT_THAT(ArrowsUp(root()), IsEmpty());
}

TEST_F(SmallHouse, AnArrowBetweenRoomsThatRunsUpIsFound) {
  Put("bus/low/a.hpp", "#include \"bus/high/b.hpp\"\n");
  EXPECT_THAT(ArrowsUp(root()), ElementsAre(HasSubstr("bus/low/a.hpp: must not include bus/high/b.hpp")));
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

TEST_F(SmallHouse, AFolderThatDoesNotSayWhatLivesThereIsFound) {
  Put("bus/low/CMakeLists.txt", "# What is below.\n");
  Put("bus/high/README.md", "# high: what is above\n");
  Put("modules/robot/CMakeLists.txt", "priamos_module(robot)\n");
  EXPECT_THAT(SilentFolders(root()), ElementsAre("modules/robot"));
}

}  // namespace
}  // namespace priamos
