#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace priamos {
namespace {

namespace fs = std::filesystem;

TEST(TopLevel, HoldsTheAgreedFoldersAndNothingElse) {
  const std::set<std::string> allowed{
      "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "bus", "config", "lcmtypes",
      "logs",           "modules",           "scripts", "test"};
  for (const auto& entry : fs::directory_iterator(PRIAMOS_SOURCE_DIR)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".") || name.starts_with("build")) continue;
    EXPECT_TRUE(allowed.contains(name)) << name;
  }
}

TEST(TopLevel, EveryScriptTheReadmeNamesCanBeRun) {
  std::ostringstream text;
  text << std::ifstream(fs::path(PRIAMOS_SOURCE_DIR) / "README.md").rdbuf();
  const std::string readme = text.str();
  static const std::regex kScript(R"(scripts/[a-z-]+)");
  int named = 0;
  for (auto it = std::sregex_iterator(readme.begin(), readme.end(), kScript); it != std::sregex_iterator();
       ++it) {
    const fs::path script = fs::path(PRIAMOS_SOURCE_DIR) / it->str();
    ++named;
    ASSERT_TRUE(fs::is_regular_file(script)) << script;
    EXPECT_NE(fs::status(script).permissions() & fs::perms::owner_exec, fs::perms::none) << script;
  }
  EXPECT_GE(named, 2);
}

TEST(TopLevel, EveryLinkOfTheReadmeLeadsSomewhere) {
  std::ostringstream text;
  text << std::ifstream(fs::path(PRIAMOS_SOURCE_DIR) / "README.md").rdbuf();
  const std::string readme = text.str();
  static const std::regex kLink(R"(\]\(([^)]+)\))");
  for (auto it = std::sregex_iterator(readme.begin(), readme.end(), kLink); it != std::sregex_iterator();
       ++it) {
    const std::string target = (*it)[1];
    if (target.starts_with("https://")) continue;
    EXPECT_TRUE(fs::exists(fs::path(PRIAMOS_SOURCE_DIR) / target)) << target;
  }
}

}  // namespace
}  // namespace priamos
