#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// What scripts/ promise to a person: help at once, a first line at once, a clear sentence when they cannot go
// on.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A clone's scripts in a folder with a blank, on a machine that has only the programs named and those added.
class ScriptsTest : public ::testing::Test {
 protected:
  ScriptsTest() {
    fs::create_directories(clone_);
    fs::create_directories(folder_ / "bin");
    fs::copy(PRIAMOS_SOURCE_DIR "/scripts", clone_ / "scripts");
    fs::create_directories(clone_ / "modules/cli");
    fs::copy(PRIAMOS_SOURCE_DIR "/modules/cli/spy", clone_ / "modules/cli/spy");
    for (const char* name : {"awk", "bash", "cat", "dirname", "dpkg-query", "env", "grep", "mktemp", "rm",
                             "sed", "sort", "tail", "tee", "tr", "mkdir", "flock", "git", "realpath"})
      for (const char* place : {"/usr/bin/", "/bin/"})
        if (fs::exists(place + std::string(name)) && !fs::exists(folder_ / "bin" / name))
          fs::create_symlink(place + std::string(name), folder_ / "bin" / name);
    Program("id", "echo 1000");
  }
  void Program(const std::string& name, const std::string& body) { Write(folder_ / "bin" / name, body); }
  void Script(const std::string& name, const std::string& body) { Write(clone_ / "scripts" / name, body); }
  void Scenario(const std::string& name) {
    const fs::path scenarios = clone_ / "config/sim/scenarios";
    fs::create_directories(scenarios);
    Write(scenarios / (name + ".toml"), "");
  }
  /// Whoever runs the tests may have chosen a preset: the clone's scripts know nothing of it.
  ShellAnswer Run(const std::string& command) const {
    return RunShell("unset PRIAMOS_PRESET; cd '" + clone_.string() + "' && PATH='" +
                    (folder_ / "bin").string() + "' " + command);
  }

 private:
  static void Write(const fs::path& file, const std::string& body) {
    fs::remove(file);
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    chmod(file.c_str(), 0755);
  }
  const TemporaryFolder folder_;
  const fs::path clone_ = folder_ / "a clone";

 protected:
  fs::path bin() const { return folder_ / "bin"; }
  fs::path clone() const { return clone_; }
};

/// Option and default of every option in a help text.
std::map<std::string, std::string> OptionsIn(const std::string& help, const std::regex& line) {
  std::map<std::string, std::string> options;
  for (std::sregex_iterator at(help.begin(), help.end(), line), end; at != end; ++at)
    options[(*at)[1]] = (*at)[2];
  return options;
}

TEST_F(ScriptsTest, TheDemosHelpNamesTheProgramsOptionsAndDefaultsAndInstallsNothing) {
  Script("setup", "echo no; exit 1");
  const auto answer = Run("scripts/demo --seed 3 --help");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  const auto program = RunShell("'" PRIAMOS_BINARY_DIR "/bin/priamos' run --help").text;
  const auto expected = OptionsIn(program, std::regex(R"(\n  (--[a-z-]+)(?: [A-Z]+=(\S+))?)"));
  const auto shown =
      OptionsIn(answer.text, std::regex(R"(\n  (--[a-z-]+) [^\n]*?(?:default: (\S+)\)|(?=\n|$)))"));
  ASSERT_GT(expected.size(), 3u);
  EXPECT_EQ(shown, expected);
}

TEST_F(ScriptsTest, SomethingIsSaidBeforeAnythingIsInstalled) {
  Script("setup", "echo \"no network\"; exit 2");
  for (const char* command : {"scripts/demo", "scripts/test"}) {
    const auto answer = Run(command);
    EXPECT_THAT(answer.text, StartsWith(fs::path(command).filename().string() + ": installing and building"));
    EXPECT_EQ(answer.exit_code, 2) << answer.text;
  }
}

TEST_F(ScriptsTest, WhoIsNotRootAndHasNoSudoIsToldWhatRootMayType) {
  const auto answer = Run("scripts/setup");
  // Where everything is installed there is nothing to ask root for.
  if (answer.exit_code == 0) {
    std::ofstream(bin() / "list.txt") << "no-such-package-of-priamos\n";
    const auto other = Run("scripts/setup '" + (bin() / "list.txt").string() + "'");
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.text,
                HasSubstr("there is no sudo; next, as root: apt-get install --no-install-recommends "
                          "no-such-package-of-priamos"));
  } else {
    EXPECT_THAT(answer.text, HasSubstr("there is no sudo; next, as root: apt-get install"));
  }
}

TEST_F(ScriptsTest, FormatInstallsItsToolWhereItIsMissing) {
  Script("setup", "echo \"asked for $*\"; exit 2");
  for (const char* command : {"scripts/format --check", "scripts/format"}) {
    const auto answer = Run(command);
    EXPECT_EQ(answer.exit_code, 2) << command;
    EXPECT_THAT(answer.text, HasSubstr("asked for scripts/packages-test.txt"))
        << command << ": next: let scripts/format call scripts/setup before clang-format-14";
  }
}

TEST_F(ScriptsTest, WithoutDebianThePackagesAreToBeInstalledByHand) {
  fs::remove(bin() / "dpkg-query");
  const auto answer = Run("scripts/setup");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.text, HasSubstr("this is no Debian"));
}

TEST_F(ScriptsTest, ABareSystemNeedsRoot) {
  const auto answer = Run("scripts/in-bare-system --check");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.text, HasSubstr("next: sudo scripts/in-bare-system"));
}

TEST_F(ScriptsTest, AParentThatCannotBeWrittenIsNamed) {
  Script("setup", "exit 0");
  Program("mkdir", "echo \"mkdir: cannot create directory 'build': Read-only file system\" >&2; exit 1");
  const auto answer = Run("scripts/build product");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.text, HasSubstr("a clone: cannot be written"));
}

TEST_F(ScriptsTest, ThePresetChangesWithoutAWipeAndStaysUntilItIsChangedAgain) {
  Script("setup", "exit 0");
  Program("ninja", "exit 0");
  // A cmake that only keeps its cache.
  Program("cmake", R"([ "$1" = --build ] && exit 0
mkdir -p build; : >>build/build.ninja; echo "$2" >>build/presets
for word in "$@"; do case $word in -D*) name=${word#-D}
  { grep -v "^${name%%=*}=" build/CMakeCache.txt; echo "$name"; } >build/new 2>/dev/null; cat build/new >build/CMakeCache.txt;; esac; done)");
  const auto presets = [&](const std::string& command) {
    const auto answer = Run(command + " >build.log 2>&1; cat build/presets");
    return answer.text;
  };
  EXPECT_EQ(presets("scripts/build product"), "release\n");
  EXPECT_EQ(presets("PRIAMOS_PRESET=dev scripts/build product"), "release\ndev\n");
  EXPECT_EQ(presets("scripts/build product"), "release\ndev\n");
  EXPECT_EQ(presets("scripts/build test_cli"), "release\ndev\ndev\n");
  EXPECT_EQ(presets("scripts/build product"), "release\ndev\ndev\n");
  EXPECT_EQ(presets("PRIAMOS_PRESET=release scripts/build"), "release\ndev\ndev\nrelease\n");
  EXPECT_EQ(presets("scripts/build"), "release\ndev\ndev\nrelease\n");
}

TEST_F(ScriptsTest, EveryScriptHasAHelpThatDoesNothing) {
  for (const auto& entry : fs::directory_iterator(PRIAMOS_SOURCE_DIR "/scripts")) {
    if (entry.path().has_extension()) continue;  // lists and settings, no scripts
    for (const char* option : {" -h", " --help"}) {
      const auto answer = Run("scripts/" + entry.path().filename().string() + option);
      EXPECT_EQ(answer.exit_code, 0) << entry.path() << answer.text;
      EXPECT_THAT(answer.text, HasSubstr("usage: ")) << entry.path();
    }
  }
}

TEST_F(ScriptsTest, AWrongWordIsNamedAndNothingIsDone) {
  Script("setup", "echo \"installing\"; exit 1");
  for (const auto& [command, got] :
       std::map<std::string, std::string>{{"scripts/build --verbose", "--verbose"},
                                          {"scripts/format --chekc", "--chekc"},
                                          {"scripts/lint no-such-revision", "no-such-revision"},
                                          {"scripts/docs --open", "--open"},
                                          {"scripts/fuzz abc", "abc"},
                                          {"scripts/spy onbord", "onbord"},
                                          {"scripts/in-private-network -x", "-x"},
                                          {"scripts/in-private-network", ""},
                                          {"scripts/in-bare-system -x", "-x"},
                                          {"scripts/demo --nonsense", "--nonsense"},
                                          {"scripts/demo --seed abc", "abc"},
                                          {"scripts/demo --ttl=x", "x"},
                                          {"scripts/demo --deployment no/where", "no/where"},
                                          {"scripts/demo --interactive --elsewhere", "--elsewhere"},
                                          {"scripts/record-run --seed", ""},
                                          {"scripts/record-run --seed one", "one"},
                                          {"scripts/record-run --into nowhere", "nowhere"}}) {
    const auto answer = Run(command);
    EXPECT_EQ(answer.exit_code, 2) << command << ": " << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("got \"" + got + "\"")) << command;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  }
}

TEST_F(ScriptsTest, TheDemoKnowsItsScenariosBeforeItBuilds) {
  Script("setup", "echo \"installing\"; exit 1");
  Scenario("door");
  for (const std::string start : {"scripts/demo", "scripts/demo --interactive"}) {
    const auto wrong = Run(start + " --scenario dor");
    EXPECT_EQ(wrong.text, "demo: --scenario: expected one of door, got \"dor\"\n");
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(Run(start + " --scenario door --seed 3").text, HasSubstr("installing"));
  }
}

TEST_F(ScriptsTest, AListOfPackagesThatIsNotThereIsNamed) {
  const auto answer = Run("scripts/setup nosuch.txt");
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_THAT(answer.text, StartsWith("setup: nosuch.txt: expected a list of packages"));
}

TEST_F(ScriptsTest, CdpathDoesNotLeadIntoAnotherClone) {
  fs::create_directories(bin() / "other/scripts");
  Script("setup", "pwd; exit 2");
  const auto answer = Run("CDPATH='" + (bin() / "other").string() + "' scripts/build product");
  EXPECT_THAT(answer.text, HasSubstr("/a clone\n"));
}

TEST_F(ScriptsTest, ABuildFolderOfAnotherPlaceIsConfiguredAnew) {
  Script("setup", "exit 0");
  Program("ninja", "exit 0");
  Program("cmake", "echo \"$@\" >>asked");
  fs::create_directories(clone() / "build");
  std::ofstream(clone() / "build/build.ninja") << "\n";
  const auto build_in = [&](const std::string& home) {
    std::ofstream(clone() / "build/CMakeCache.txt")
        << "PRIAMOS_PRESET:STRING=dev\nPRIAMOS_TESTS:BOOL=ON\nCMAKE_HOME_DIRECTORY:INTERNAL=" << home << "\n";
    return Run("scripts/build product; cat asked; rm asked").text;
  };
  EXPECT_THAT(build_in(clone()), Not(HasSubstr("--preset")));
  const std::string moved = build_in("/elsewhere");
  EXPECT_THAT(moved, HasSubstr("build/ was made for /elsewhere"));
  EXPECT_THAT(moved, HasSubstr("--preset dev"));
  EXPECT_THAT(moved, HasSubstr("-DPRIAMOS_TESTS:BOOL=ON"));
}

TEST_F(ScriptsTest, APathThatCMakeCannotBearIsRefused) {
  for (const char* name : {"a[1]", "a#b", "a;b", "a*"}) {
    fs::create_directories(bin() / name);
    fs::copy(clone() / "scripts", bin() / name / "scripts");
    const auto answer = Run(fmt::format("'{}'", (bin() / name / "scripts/build").string()));
    EXPECT_EQ(answer.exit_code, 2) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(std::string(name) + ": CMake cannot build in a path"));
  }
}

TEST_F(ScriptsTest, ASecondBuildWaitsAndSaysSo) {
  Script("setup", "exit 3");
  fs::create_directories(clone() / "build");
  const int folder = open((clone() / "build").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  const auto waiting = Run("/usr/bin/timeout 1 scripts/build product");
  EXPECT_THAT(waiting.text, HasSubstr("another scripts/build is at work"));
  EXPECT_EQ(waiting.exit_code, 124);
  close(folder);
  EXPECT_EQ(Run("scripts/build product").exit_code, 3);
}

TEST_F(ScriptsTest, ATargetThatNobodyKnowsIsNamed) {
  Script("setup", "exit 0");
  Program("ninja", "exit 1");
  Program("cmake", "exit 0");
  const auto answer = Run("scripts/build prodcut");
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("build: expected a target, got \"prodcut\""));
}

}  // namespace
}  // namespace priamos
