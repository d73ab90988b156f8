#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <iterator>
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
  std::vector<std::pair<std::string, std::string>> second;  ///< folder, and library beside the one it has
};

/// The words of a command; those within generator expressions too.
std::vector<std::string> WordsOf(const std::string& text) {
  std::istringstream in(std::regex_replace(text, std::regex(R"([$<>:,;"{}])"), " "));
  return {std::istream_iterator<std::string>(in), {}};
}

/// set_property(TARGET a PROPERTY INTERFACE_LINK_LIBRARIES b), and set_target_properties.
void AddProperty(const std::vector<std::string>& words, Libraries& libraries) {
  const auto is_end = [](const std::string& w) { return w == "APPEND" || w.starts_with("PROPERT"); };
  const auto end = std::find_if(words.begin(), words.end(), is_end);
  const auto is_link = [](const std::string& w) { return w.ends_with("LINK_LIBRARIES"); };
  if (std::none_of(end, words.end(), is_link)) return;
  for (auto target = words.begin(); target != end; ++target)
    libraries.links[*target].insert(end, words.end());
}

void AddLibrary(const std::string& folder, const std::string& name, Libraries& libraries) {
  if (!libraries.of_folder.emplace(folder, name).second) libraries.second.emplace_back(folder, name);
}

void AddCommand(const std::string& folder, const std::smatch& command, Libraries& libraries) {
  const std::string verb = command[1];
  const std::vector<std::string> words = WordsOf(command[3]);
  if (verb.starts_with("set_")) {
    std::vector<std::string> all = words;
    all.insert(all.begin(), command[2]);
    return AddProperty(all, libraries);
  }
  const std::string name = command[2].str() + (verb == "priamos_module" ? "_app" : "");
  // The root has no library of its own, but can link those of others.
  if (verb != "target_link_libraries" && !folder.empty()) AddLibrary(folder, name, libraries);
  if (verb != "add_library") libraries.links[name].insert(words.begin(), words.end());
}

Libraries LibrariesOf(const fs::path& root) {
  static const std::regex kComment("#[^\n]*");
  static const std::regex kCommand(
      R"(\b(priamos_library|priamos_module|add_library|target_link_libraries|set_property|set_target_properties)\(\s*([\w-]+)([^)]*)\))");
  Libraries libraries;
  for (const std::string& folder : FolderOrder(root)) {
    const std::string text = std::regex_replace(TextOf(root / folder / "CMakeLists.txt"), kComment, "");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), kCommand); it != std::sregex_iterator();
         ++it)
      AddCommand(folder, *it, libraries);
  }
  return libraries;
}

bool IsProduct(const std::string& folder) {
  return folder == "lcmtypes" || folder.starts_with("bus") || folder.starts_with("modules/");
}

/// Folders of the product with more than one library.
std::vector<std::string> SecondLibraries(const fs::path& root) {
  const Libraries libraries = LibrariesOf(root);
  std::vector<std::string> found;
  for (const auto& [folder, name] : libraries.second)
    if (IsProduct(folder))
      found.push_back(
          fmt::format("{0}/CMakeLists.txt: {1} is a second library beside {2}; next: give {1} a "
                      "folder of its own",
                      folder, name, libraries.of_folder.at(folder)));
  return found;
}

/// Libraries of cores that link messages or the bus.
std::vector<std::string> ImpureCores(const fs::path& root) {
  const Libraries libraries = LibrariesOf(root);
  std::set<std::string> impure;
  for (const auto& [folder, name] : libraries.of_folder)
    if (folder == "lcmtypes" || folder == "bus" || folder.starts_with("bus/")) impure.insert(name);
  std::vector<std::string> found;
  for (const auto& [folder, name] : libraries.of_folder) {
    const auto linked = libraries.links.find(name);
    if (linked == libraries.links.end() || (folder + "/").find("/core/") == std::string::npos) continue;
    for (const std::string& other : linked->second)
      if (impure.contains(other))
        found.push_back(fmt::format(
            "{}/CMakeLists.txt: {} is of a core and must not link {}; next: leave it to the shell", folder,
            name, other));
  }
  return found;
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

void Reach(const Libraries& libraries, const std::string& from, std::set<std::string>& reached) {
  if (const auto linked = libraries.links.find(from); linked != libraries.links.end())
    for (const std::string& next : linked->second)
      if (reached.insert(next).second) Reach(libraries, next, reached);
}

/// Whether `from` links `to`, directly or through others.
bool Links(const Libraries& libraries, const std::string& from, const std::string& to) {
  std::set<std::string> reached;
  Reach(libraries, from, reached);
  return reached.contains(to);
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

TEST(LinkRules, AFolderHasOneLibrary) {
  EXPECT_THAT(SecondLibraries(PRIAMOS_SOURCE_DIR), IsEmpty());
}

TEST(LinkRules, NoCoreLinksMessagesOrTheBus) {
  EXPECT_THAT(ImpureCores(PRIAMOS_SOURCE_DIR), IsEmpty());
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

TEST_F(LinksOfSmallHouse, UpInOtherSpellingsAreFound) {
  for (const char* spelling :
       {"target_link_libraries(bus_low PUBLIC $<BUILD_INTERFACE:bus_high>)\n",
        "set_property(TARGET bus_low APPEND PROPERTY INTERFACE_LINK_LIBRARIES bus_high)\n",
        "set_target_properties(bus_low PROPERTIES LINK_LIBRARIES \"bus_high\")\n"}) {
    Put("bus/low/CMakeLists.txt", std::string("priamos_library(bus_low)\n") + spelling);
    EXPECT_THAT(LinksUp(root()), ElementsAre(HasSubstr("bus/low: bus_low must not link bus_high")))
        << spelling;
  }
}

TEST_F(LinksOfSmallHouse, UpWrittenInTheRootAreFound) {
  Put("CMakeLists.txt",
      "add_subdirectory(lcmtypes)\nadd_subdirectory(bus)\nadd_subdirectory(modules/robot)\n"
      "target_link_libraries(bus_low INTERFACE robot_app)\n");
  EXPECT_THAT(LinksUp(root()), ElementsAre(HasSubstr("bus/low: bus_low must not link robot_app")));
}

TEST_F(LinksOfSmallHouse, ThatAreMutualAreFollowedOnce) {
  Put("bus/low/CMakeLists.txt", "priamos_library(bus_low LIBS bus_high)\n");
  EXPECT_THAT(MissingLinks(root()), IsEmpty());
  EXPECT_THAT(LinksUp(root()), ElementsAre(HasSubstr("bus_low must not link bus_high")));
}

TEST_F(LinksOfSmallHouse, OfACoreToMessagesAreFound) {
  Put("modules/robot/CMakeLists.txt", "add_subdirectory(core)\npriamos_module(robot LIBS lcmtypes bus)\n");
  Put("modules/robot/core/CMakeLists.txt", "priamos_library(robot_core LIBS lcmtypes bus_low)\n");
  EXPECT_THAT(ImpureCores(root()), ElementsAre(HasSubstr("robot_core is of a core and must not link bus_low"),
                                               HasSubstr("must not link lcmtypes; next: leave it")));
}

TEST_F(LinksOfSmallHouse, ASecondLibraryOfAFolderIsFoundInOneSentence) {
  Put("bus/low/CMakeLists.txt", "priamos_library(bus_low)\nadd_library(bus_other STATIC x.cpp)\n");
  EXPECT_THAT(SecondLibraries(root()),
              ElementsAre("bus/low/CMakeLists.txt: bus_other is a second library beside "
                          "bus_low; next: give bus_other a folder of its own"));
  EXPECT_THAT(MissingLinks(root()), IsEmpty());
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
