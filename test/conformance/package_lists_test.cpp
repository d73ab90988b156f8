#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "debian_packages.hpp"
#include "test/support/project_files.hpp"
#include "test/support/temporary_folder.hpp"

// A command's package lists hold whatever CMake finds when that command configures: a machine of a developer
// has more installed than a bare one, and hides what a list lacks.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> Lines(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What a command of scripts/ asks of scripts/setup and of cmake.
struct Asked {
  std::vector<std::string> packages;
  std::string cmake_arguments;
};

/// Runs the command in a copy of scripts/ where setup and cmake only note down what they were asked for.
class RecordedCommand {
 public:
  RecordedCommand() {
    fs::create_directories(clone_);
    fs::copy(PRIAMOS_SOURCE_DIR "/scripts", clone_ / "scripts");
    fs::remove(clone_ / "scripts/setup");
    Program("scripts/setup", "cat \"$@\" >> packages");
    Program("cmake", "printf \"'%s' \" \"$@\" > configured; exit 1");
  }
  Asked Run(const std::string& command) {
    RunShell("cd '" + clone_.string() + "' && PATH=\"$PWD:$PATH\" PRIAMOS_PRESET= " + command);
    Asked asked;
    for (const std::string& line : Lines(clone_ / "packages"))
      if (!line.empty() && line[0] != '#') asked.packages.push_back(line);
    for (const std::string& line : Lines(clone_ / "configured")) asked.cmake_arguments += line;
    return asked;
  }

 private:
  void Program(const std::string& name, const std::string& body) {
    const fs::path file = clone_ / name;
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    chmod(file.c_str(), 0755);
  }
  const TemporaryFolder folder_;
  const fs::path clone_ = folder_ / "a clone";
};

/// CMake takes LLVM's tools where there are some, and else those that every compiler brings.
bool IsOneOfSeveralTools(const std::string& variable) {
  return variable.starts_with("CMAKE_") && !variable.ends_with("_COMPILER") &&
         variable != "CMAKE_MAKE_PROGRAM";
}

/// The files and folders of the system that CMake noted in its cache.
std::set<std::string> FoundBy(const fs::path& cache) {
  static const std::set<std::string> kEverybodys{"/usr", "/usr/local", "/usr/include", "/usr/lib"};
  std::set<std::string> found;
  for (const std::string& line : Lines(cache)) {
    const auto colon = line.find(':'), equals = line.find('=');
    if (colon == std::string::npos || equals == std::string::npos || colon > equals) continue;
    if (IsOneOfSeveralTools(line.substr(0, colon))) continue;
    // A value may be a list of paths.
    std::istringstream values(line.substr(equals + 1));
    for (std::string value; std::getline(values, value, ';');) {
      const bool of_the_system =
          value.starts_with("/usr/") || value.starts_with("/lib") || value.starts_with("/bin");
      if (of_the_system && !kEverybodys.contains(value) && fs::exists(value)) found.insert(value);
    }
  }
  return found;
}

/// A sentence for everything in `found` that no package of the closure of `packages` brings.
std::vector<std::string> Lacking(const std::set<std::string>& found,
                                 const std::vector<std::string>& packages) {
  const auto closure = DebianPackages().Closure(packages);
  std::vector<std::string> lacking;
  for (const auto& [path, owners] : DebianPackages::OwnersOf(found)) {
    const bool there = std::any_of(owners.begin(), owners.end(),
                                   [&](const std::string& owner) { return closure.contains(owner); });
    if (!there) lacking.push_back(fmt::format("{} ({})", path, fmt::join(owners, ", ")));
  }
  return lacking;
}

struct Case {
  const char* name;
  const char* command;
  const char* needed;  ///< a package that is found by CMake and brought by no other
};
void PrintTo(const Case& command, std::ostream* out) {
  *out << command.command;
}

class PackageLists : public ::testing::TestWithParam<Case> {};

TEST_P(PackageLists, HoldWhatCMakeFindsForTheSameCommand) {
  const Asked asked = RecordedCommand().Run(GetParam().command);
  ASSERT_FALSE(asked.packages.empty());
  ASSERT_THAT(asked.cmake_arguments, HasSubstr("-D"));
  const bool needs_clang = asked.cmake_arguments.find("clang++") != std::string::npos;
  if (needs_clang && RunShell("clang++ --version").exit_code != 0)
    GTEST_SKIP() << "no clang; scripts/fuzz and scripts/test --fuzz install it";
  const TemporaryFolder build;
  const ShellAnswer answer = RunShell("cd '" PRIAMOS_SOURCE_DIR "' && cmake " + asked.cmake_arguments +
                                      " -B '" + build.path().string() + "'");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const auto found = FoundBy(build / "CMakeCache.txt");
  EXPECT_GT(found.size(), 20u);
  EXPECT_THAT(Lacking(found, asked.packages), IsEmpty());

  auto fewer = asked.packages;
  ASSERT_EQ(std::erase(fewer, GetParam().needed), 1u);
  EXPECT_THAT(Lacking(found, fewer), Contains(HasSubstr(GetParam().needed)));
}

INSTANTIATE_TEST_SUITE_P(All, PackageLists,
                         ::testing::Values(Case{"demo", "scripts/demo", "libspnav-dev"},
                                           Case{"test", "scripts/test", "librapidcheck-dev"},
                                           Case{"spy", "scripts/spy", "liblcm-java"},
                                           Case{"fuzz", "scripts/fuzz", "librapidcheck-dev"}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(DebianPackages, AClosureFollowsDependenciesAlternativesAndProviders) {
  const DebianPackages dut(
      "base\tyes\t\t, libc6\n"
      "libc6\t\t\t\n"
      "apt\t\t\tlibc6 (>= 2)\n"
      "tool\t\t\tabsent | lib:any (>= 1), editor\n"
      "lib\t\t\t\n"
      "vi\t\teditor (= 1)\t\n"
      "other\t\t\tlib\n");
  EXPECT_THAT(dut.Closure({}), ::testing::ElementsAre("apt", "base", "libc6"));
  EXPECT_THAT(dut.Closure({"tool", "unknown"}),
              ::testing::ElementsAre("apt", "base", "lib", "libc6", "tool", "vi"));
}

}  // namespace
}  // namespace priamos
