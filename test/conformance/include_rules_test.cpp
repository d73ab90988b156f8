#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>

#include "source_tree.hpp"
#include "test/support/project_files.hpp"

// Who may include whom: the rule that keeps the architecture readable from the folders (README.md).

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

/// The room a file or an include belongs to: "lcmtypes", "common", "bus", "robot/core", "robot" ...
/// Every other first folder is a module, so that a new one is under the rules from its first file on.
std::optional<std::string> RoomOf(const std::string& path) {
  static const std::regex kModuleFile(R"((?:modules/)?([a-z_0-9]+)/(core/)?.*)");
  if (path.starts_with("lcmtypes/") || path.starts_with("priamos/")) return "lcmtypes";
  if (path.starts_with("bus/")) return "bus";
  if (path.starts_with("common/") || path.starts_with("modules/common/")) return "common";
  std::smatch m;
  if (!std::regex_match(path, m, kModuleFile)) return std::nullopt;
  return m[2].matched ? m[1].str() + "/core" : m[1].str();
}

bool Allowed(const std::string& from, const std::string& to) {
  if (from == to || to == "common") return from != "lcmtypes" || to == "lcmtypes";
  if (from == "lcmtypes" || from == "common") return false;
  if (from == "bus") return to == "lcmtypes";
  if (from.ends_with("/core")) return false;
  if (to == "bus" || to == "lcmtypes") return true;
  if (to == from + "/core") return true;
  // The command line is where modules come together: it starts their Apps and reads their files and
  // configurations. Their cores stay theirs.
  return from == "cli" && !to.ends_with("/core");
}

/// Third-party headers a room must not see; everything in `only` may stand in the named rooms alone.
bool LibraryAllowed(const std::string& from, const std::string& file, const std::string& header) {
  const auto in = [&](std::initializer_list<const char*> rooms) {
    return std::any_of(rooms.begin(), rooms.end(), [&](const char* r) { return from == r; });
  };
  if (header.starts_with("opencv2/")) return in({"head/core", "world/core", "head", "world"});
  if (header.starts_with("cairo") || header.starts_with("pango"))
    return file.starts_with("modules/common/drawing/");
  if (header.starts_with("mrpt/"))
    return from.ends_with("/core") || file.starts_with("modules/cli/verbs/mrpt/");
  if (header.starts_with("ceres/")) return in({"head/core"});
  if (header.starts_with("lcm/")) return file == "bus/wire/lcm_bus.cpp";
  if (header.starts_with("sodium")) return in({"bus", "cli", "radio"});
  if (header.starts_with("boost/")) return file.starts_with("modules/common/web/");
  if (header.starts_with("toml++/")) return file.starts_with("modules/common/config");
  return true;
}

/// Whether an include in angle brackets means a header of the project: those of messages are found that way
/// too.
bool IsOwnHeader(const std::string& header) {
  static const std::regex kOwn("(?:priamos|lcmtypes|bus|common|modules)/.*");
  return std::regex_match(header, kOwn);
}

std::vector<std::string> Violations(const std::string& file, const std::string& text) {
  static const std::regex kInclude(R"re(#include\s+(["<])([^">]+)[">])re");
  std::vector<std::string> found;
  const auto from = RoomOf(file);
  if (!from) return found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), kInclude); it != std::sregex_iterator();
       ++it) {
    const std::string header = (*it)[2];
    const auto to = (*it)[1] == "\"" || IsOwnHeader(header) ? RoomOf(header) : std::nullopt;
    if (to && !Allowed(*from, *to))
      found.push_back(fmt::format("{}: {} must not include {}", file, *from, header));
    if (!to && !LibraryAllowed(*from, file, header))
      found.push_back(fmt::format("{}: {} must not use <{}>", file, *from, header));
  }
  return found;
}

std::string Read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(IncludeRules, HoldInEverySourceFile) {
  const fs::path root = PRIAMOS_SOURCE_DIR;
  std::vector<std::string> found;
  int files = 0;
  for (const char* folder : {"lcmtypes", "bus", "modules"}) {
    for (const fs::path& file : ProjectFiles(folder)) {
      if (file.extension() != ".hpp" && file.extension() != ".cpp") continue;
      if (IsStandalone(file.parent_path())) continue;
      ++files;
      const auto more = Violations(file.string(), Read(root / file));
      found.insert(found.end(), more.begin(), more.end());
    }
  }
  EXPECT_GT(files, 50);
  EXPECT_THAT(found, IsEmpty());
}

TEST(IncludeRules, AModuleMayNotIncludeAnother) {
  EXPECT_THAT(Violations("modules/robot/robot_app.cpp", "#include \"head/core/x.hpp\"\n"),
              testing::ElementsAre(HasSubstr("must not include head/core/x.hpp")));
}

TEST(IncludeRules, ACoreMayNotIncludeTheBusOrMessages) {
  EXPECT_EQ(Violations("modules/robot/core/x.hpp", "#include \"bus/node.hpp\"\n").size(), 1u);
  EXPECT_EQ(Violations("modules/robot/core/x.hpp", "#include \"lcmtypes/channels.hpp\"\n").size(), 1u);
  EXPECT_EQ(Violations("modules/robot/core/x.hpp", "#include \"priamos/pose_t.hpp\"\n").size(), 1u);
}

TEST(IncludeRules, AngleBracketsHideNoMessage) {
  EXPECT_THAT(
      Violations("modules/robot/core/x.hpp", "#include <priamos/pose_t.hpp>\n"),
      testing::ElementsAre("modules/robot/core/x.hpp: robot/core must not include priamos/pose_t.hpp"));
  EXPECT_THAT(Violations("modules/robot/x.hpp", "#include <priamos/pose_t.hpp>\n"), IsEmpty());
}

TEST(IncludeRules, ANewModuleIsUnderTheRulesFromItsFirstFileOn) {
  EXPECT_EQ(Violations("modules/battery/core/x.hpp", "#include \"bus/node.hpp\"\n").size(), 1u);
  EXPECT_EQ(Violations("modules/battery/x.hpp", "#include \"robot/robot_app.hpp\"\n").size(), 1u);
  EXPECT_EQ(Violations("modules/robot/x.hpp", "#include \"battery/x.hpp\"\n").size(), 1u);
}

TEST(IncludeRules, TheCommandLineMayIncludeAModulesShellButNotItsCore) {
  EXPECT_THAT(Violations("modules/cli/verbs/x.cpp", "#include \"robot/robot_app.hpp\"\n"), IsEmpty());
  EXPECT_EQ(Violations("modules/cli/verbs/x.cpp", "#include \"robot/core/base/x.hpp\"\n").size(), 1u);
}

TEST(IncludeRules, TheBusKnowsNoRobot) {
  EXPECT_EQ(Violations("bus/node.hpp", "#include \"robot/core/x.hpp\"\n").size(), 1u);
}

TEST(IncludeRules, OnlyOneFileCallsLiblcm) {
  EXPECT_EQ(Violations("bus/node.cpp", "#include <lcm/lcm.h>\n").size(), 1u);
  EXPECT_THAT(Violations("bus/wire/lcm_bus.cpp", "#include <lcm/lcm.h>\n"), IsEmpty());
}

TEST(IncludeRules, ShellsMayUseTheirCoreTheBusAndMessages) {
  EXPECT_THAT(
      Violations(
          "modules/robot/robot_app.hpp",
          "#include \"bus/context.hpp\"\n#include \"robot/core/x.hpp\"\n#include \"lcmtypes/channels.hpp\"\n"
          "#include \"common/time.hpp\"\n"),
      IsEmpty());
}

}  // namespace
}  // namespace priamos
