#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "small_house.hpp"
#include "source_tree.hpp"

// Libraries link as folders include: CMake shows the headers of a folder's subfolders with its own, so what
// the compiler takes is more than what a room links. These rules read the CMakeLists.txt files instead.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The libraries of a tree: of every folder its library, and of every library what it links.
struct Libraries {
  std::map<std::string, std::string> of_folder;
  std::map<std::string, std::set<std::string>> links;
};

void AddCommand(const std::string& folder, const std::smatch& command, Libraries& libraries) {
  const bool module = command[1] == "priamos_module", links = command[1] != "add_library";
  const std::string name = command[2].str() + (module ? "_app" : "");
  if (command[1] != "target_link_libraries") libraries.of_folder[folder] = name;
  std::istringstream words(command[3]);
  for (std::string word; links && words >> word;) libraries.links[name].insert(word);
}

Libraries LibrariesOf(const fs::path& root) {
  static const std::regex kComment("#[^\n]*");
  static const std::regex kCommand(
      R"(\b(priamos_library|priamos_module|add_library|target_link_libraries)\(\s*([\w-]+)([^)]*)\))");
  Libraries libraries;
  for (const std::string& folder : FolderOrder(root)) {
    const std::string text = std::regex_replace(TextOf(root / folder / "CMakeLists.txt"), kComment, "");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), kCommand); it != std::sregex_iterator();
         ++it)
      if (!folder.empty()) AddCommand(folder, *it, libraries);
  }
  return libraries;
}

/// Libraries that link one whose folder is named later.
std::vector<std::string> LinksUp(const fs::path& root) {
  const Libraries libraries = LibrariesOf(root);
  std::map<std::string, std::size_t> place;
  const auto order = FolderOrder(root);
  for (std::size_t i = 0; i < order.size(); ++i)
    if (const auto it = libraries.of_folder.find(order[i]); it != libraries.of_folder.end())
      place[it->second] = i;
  std::vector<std::string> found;
  for (const auto& [folder, name] : libraries.of_folder)
    if (const auto linked = libraries.links.find(name); linked != libraries.links.end())
      for (const std::string& other : linked->second)
        if (place.contains(other) && place.at(other) >= place.at(name))
          found.push_back(
              fmt::format("{}: {} must not link {}, whose folder is named later", folder, name, other));
  return found;
}

/// Whether `from` links `to`, directly or through others.
bool Links(const Libraries& libraries, const std::string& from, const std::string& to) {
  const auto linked = libraries.links.find(from);
  return linked != libraries.links.end() &&
         std::any_of(linked->second.begin(), linked->second.end(),
                     [&](const std::string& next) { return next == to || Links(libraries, next, to); });
}

/// Folders with sources but no library, and includes of a room that the library does not link.
std::vector<std::string> MissingLinks(const fs::path& root) {
  const Libraries libraries = LibrariesOf(root);
  std::set<std::string> found;
  for (const fs::path& source : SourcesIn(root, {"lcmtypes", "bus", "modules"})) {
    if (source.extension() == ".java") continue;
    const std::string folder = source.parent_path().string();
    const auto from = libraries.of_folder.find(folder);
    if (from == libraries.of_folder.end()) {
      found.insert(folder + ": no priamos_library");
      continue;
    }
    for (const std::string& header : QuotedIncludes(TextOf(root / source))) {
      const auto to = libraries.of_folder.find(FolderOf(root, header));
      if (to != libraries.of_folder.end() && to != from && !Links(libraries, from->second, to->second))
        found.insert(fmt::format("{}: {} includes {}, but {} does not link {}", folder,
                                 source.filename().string(), header, from->second, to->second));
    }
  }
  return {found.begin(), found.end()};
}

TEST(LinkRules, NoLibraryLinksUp) {
  EXPECT_GT(LibrariesOf(PRIAMOS_SOURCE_DIR).of_folder.size(), 50u);
  EXPECT_THAT(LinksUp(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(LinkRules, ALibraryLinksEveryRoomThatItIncludes) {
  EXPECT_THAT(MissingLinks(PRIAMOS_SOURCE_DIR), IsEmpty());
}

using LinksOfSmallHouse = SmallHouse;

TEST_F(LinksOfSmallHouse, AreRightAsTheyStand) {
  EXPECT_THAT(LinksUp(root()), IsEmpty());
  EXPECT_THAT(MissingLinks(root()), IsEmpty()) << "robot links bus_low through bus";
}

TEST_F(LinksOfSmallHouse, UpInLibsAreFound) {
  Put("bus/low/CMakeLists.txt", "priamos_library(bus_low LIBS fmt::fmt bus_high)\n");
  EXPECT_THAT(LinksUp(root()), ElementsAre(HasSubstr("bus/low: bus_low must not link bus_high")));
}

TEST_F(LinksOfSmallHouse, UpByTargetLinkLibrariesAreFound) {
  Put("bus/low/CMakeLists.txt",
      "priamos_library(bus_low)\ntarget_link_libraries(bus_low PUBLIC robot_app)\n");
  EXPECT_THAT(LinksUp(root()), ElementsAre(HasSubstr("bus/low: bus_low must not link robot_app")));
}

TEST_F(LinksOfSmallHouse, ThatAnIncludeNeedsAreMissed) {
  Put("bus/high/CMakeLists.txt", "priamos_library(bus_high LIBS fmt::fmt)  # not bus_low\n");
  EXPECT_THAT(MissingLinks(root()),
              ElementsAre("bus/high: b.hpp includes bus/low/a.hpp, but bus_high does not "
                          "link bus_low"));
}

TEST_F(LinksOfSmallHouse, ToTheMessagesAreMissedLikeOthers) {
  Put("modules/robot/CMakeLists.txt", "priamos_module(robot LIBS bus)\n");
  EXPECT_THAT(MissingLinks(root()), ElementsAre(HasSubstr("robot_app does not link lcmtypes")));
}

TEST_F(LinksOfSmallHouse, OfARoomWithoutLibraryAreMissed) {
  Put("bus/low/CMakeLists.txt", "# What is below.\n");
  EXPECT_THAT(MissingLinks(root()), ElementsAre("bus/low: no priamos_library"));
}

}  // namespace
}  // namespace priamos
