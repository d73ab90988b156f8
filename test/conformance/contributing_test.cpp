#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "bus/radio/budget.hpp"
#include "bus/radio/link_config.hpp"
#include "bus/type_files.hpp"
#include "common/config.hpp"
#include "lcm_rules.hpp"
#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// The recipes of CONTRIBUTING.md: what they name is there, and who follows them arrives.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string Read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string Guide() {
  return Read(PRIAMOS_SOURCE_DIR "/CONTRIBUTING.md");
}

/// One numbered line of a recipe: a file or folder, and a word that stands in it.
struct Step {
  std::string path, word;
};

struct Recipe {
  std::string title;
  std::string like;  ///< what is there already and was made in the same way
  std::vector<Step> steps;
};

std::vector<Recipe> RecipesIn(const std::string& guide) {
  static const std::regex kLike(R"(Like `(\w+)`\..*)");
  static const std::regex kStep(R"(\d+\. `([^`]+)`(?: at `([^`]+)`)?:.*)");
  std::vector<Recipe> recipes;
  std::istringstream in(guide);
  std::smatch m;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("### ")) recipes.push_back({line.substr(4), "", {}});
    if (recipes.empty()) continue;
    if (std::regex_match(line, m, kLike)) recipes.back().like = m[1];
    if (std::regex_match(line, m, kStep)) recipes.back().steps.push_back({m[1], m[2]});
  }
  return recipes;
}

/// The text with <name>, <Name> and <NAME> filled in.
std::string Named(std::string text, const std::string& name) {
  std::string camel = name, upper = name;
  camel[0] = static_cast<char>(std::toupper(camel[0]));
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  text = std::regex_replace(text, std::regex("<name>"), name);
  text = std::regex_replace(text, std::regex("<Name>"), camel);
  return std::regex_replace(text, std::regex("<NAME>"), upper);
}

/// Text of a file; of a folder, the texts of the files that lie directly in it.
std::string TextOf(const fs::path& place) {
  if (!fs::is_directory(place)) return Read(place);
  std::string text;
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.is_regular_file()) text += Read(entry.path());
  return text;
}

/// What of the recipe is not so for the thing it says it is like.
std::vector<std::string> Untrue(const Recipe& recipe, const fs::path& root) {
  std::vector<std::string> untrue;
  for (const Step& step : recipe.steps) {
    const std::string path = Named(step.path, recipe.like), word = Named(step.word, recipe.like);
    if (!fs::exists(root / path))
      untrue.push_back(fmt::format("{}: there is no {}", recipe.title, path));
    else if (TextOf(root / path).find(word) == std::string::npos)
      untrue.push_back(fmt::format("{}: {} has no {}", recipe.title, path, word));
  }
  return untrue;
}

TEST(Contributing, EveryRecipeIsTrueOfWhatItNamesAsItsLike) {
  std::vector<std::string> titles;
  for (const Recipe& recipe : RecipesIn(Guide())) {
    titles.push_back(recipe.title);
    EXPECT_FALSE(recipe.like.empty()) << recipe.title;
    EXPECT_GE(recipe.steps.size(), 2u) << recipe.title;
    EXPECT_THAT(Untrue(recipe, PRIAMOS_SOURCE_DIR), IsEmpty());
  }
  EXPECT_THAT(titles, ElementsAre("A message", "A channel to the radio", "A live key", "A module", "A room",
                                  "A landmark kind", "A verb", "A mission", "A scenario"));
}

TEST(Contributing, AnUntrueStepIsFound) {
  const TemporaryFolder folder;
  std::ofstream(folder / "door.txt") << "kDoor";
  const auto recipes = RecipesIn(
      "### A thing\nLike `door`. Easy.\n\n1. `<name>.txt` at `k<Name>`: is there.\n"
      "2. `<name>.txt` at `<NAME>`: is not.\n3. `<name>.cpp`: is no file.\n");
  ASSERT_EQ(recipes.size(), 1u);
  EXPECT_THAT(Untrue(recipes[0], folder.path()),
              ElementsAre("A thing: door.txt has no DOOR", "A thing: there is no door.cpp"));
}

// ---- A message and a channel to the radio, added to a copy of the tree as the guide shows.

/// The first block of the guide in that language.
std::string Block(const std::string& language) {
  const std::string guide = Guide(), begin = "\n```" + language + "\n";
  const auto from = guide.find(begin);
  if (from == std::string::npos) return "";
  return guide.substr(from + begin.size(), guide.find("```", from + begin.size()) - from - begin.size());
}

class FollowedRecipe : public testing::Test {
 protected:
  FollowedRecipe() {
    fs::copy(PRIAMOS_SOURCE_DIR "/lcmtypes", folder_ / "lcmtypes");
    fs::copy(PRIAMOS_SOURCE_DIR "/config/sim/link.toml", folder_ / "link.toml");
  }
  void AddMessage() { std::ofstream(folder_ / "lcmtypes/battery_t.lcm") << Block("lcm"); }
  void AddChannel() {
    std::string text = Read(folder_ / "lcmtypes/channels.hpp");
    const auto after = [&](const std::string& place, const std::string& added) {
      const auto at = text.find(place);
      ASSERT_NE(at, std::string::npos) << place;
      text.insert(at + place.size(), added);
    };
    after("#include \"priamos/alarm_t.hpp\"\n", "#include \"priamos/battery_t.hpp\"\n");
    after("milliseconds(200)};\n", Block("cpp"));
    after("kAll{", "kBattery, ");
    std::ofstream(folder_ / "lcmtypes/channels.hpp") << text;
  }
  void AddToRadio() { std::ofstream(folder_ / "link.toml", std::ios::app) << "\n" << Block("toml"); }

  bus::Schema Types() const { return bus::Schema(bus::ReadTypeFiles((folder_ / "lcmtypes").string())); }
  /// The table that `priamos link budget` shows. Throws ConfigError, as the link does when it starts.
  std::string Budget() const {
    const auto link = LoadConfig<bus::radio::LinkConfig>((folder_ / "link.toml").string());
    const bus::Schema types = Types();
    const bus::radio::ChannelTable table = link.Table(types);
    RequireBudget(table, link.Options());
    return FormatBudget(table, ComputeBudget(table, link.Options()));
  }
  ShellAnswer In(const std::string& command) const {
    return RunShell("cd '" + folder_.path().string() + "' && " + command);
  }
  TemporaryFolder folder_;
};

TEST_F(FollowedRecipe, TheMessageKeepsTheRulesAndTheChannelCompiles) {
  AddMessage();
  AddChannel();
  EXPECT_THAT(bus::Violations(Types()), IsEmpty());
  ASSERT_EQ(In("lcm-gen -x --cpp-std c++11 --cpp-hpath made lcmtypes/*.lcm").exit_code, 0);
  std::ofstream(folder_ / "use.cpp")
      << "#include \"lcmtypes/channels.hpp\"\nusing namespace priamos;\n"
         "static_assert(std::get<0>(channels::kAll).name == \"BATTERY\");\n"
         "static_assert(std::is_same_v<decltype(channels::kBattery)::Message, battery_t>);\n";
  const ShellAnswer answer = In("c++ -std=c++20 -fsyntax-only -I. -Imade use.cpp");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
}

TEST_F(FollowedRecipe, TheRadioCarriesItWithinItsDeadlines) {
  AddMessage();
  AddToRadio();
  EXPECT_THAT(Budget(), HasSubstr("BATTERY"));
}

TEST_F(FollowedRecipe, AStepLeftOutIsNamed) {
  AddToRadio();
  try {
    Budget();
    FAIL() << "no type, and nobody minds";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("battery_t"));
  }
  AddChannel();
  ASSERT_EQ(In("lcm-gen -x --cpp-std c++11 --cpp-hpath made lcmtypes/*.lcm").exit_code, 0);
  std::ofstream(folder_ / "use.cpp") << "#include \"lcmtypes/channels.hpp\"\n";
  EXPECT_THAT(In("c++ -std=c++20 -fsyntax-only -I. -Imade use.cpp").text, HasSubstr("battery_t.hpp"));
}

}  // namespace
}  // namespace priamos
