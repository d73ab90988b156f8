#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <regex>

#include "private_network.hpp"
#include "test/support/readme_blocks.hpp"
#include "test/support/readme_material.hpp"
#include "test/support/temporary_folder.hpp"

// Every block of commands of every README, as a person types it: line by line in one shell, in a copy of the
// tree that holds the files the READMEs speak of, in a network of its own in which the recorded run is
// played.

namespace priamos {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

struct Rule {
  std::string command;  ///< regular expression of what a line begins with
  std::string text;     ///< see the list
};

/// What no test can run, with the reason. This is the only such list.
const std::vector<Rule> kNotRun{
    {"scripts/demo", "installs, builds and drives: .ci/run does it on a bare system"},
    {"scripts/test", "it runs this test"},
    {"cmake --(install|build) build", "it installs: install_test.cpp does, into a folder of its own"},
};

/// What goes on until it is stopped, with a regular expression of what proves that it works. Ctrl-C must end
/// it.
const std::vector<Rule> kUntilStopped{
    {"priamos topic list .*--watch", "POSE +(priamos.pose_t +)?[0-9]"},
    {"priamos topic (echo|hz|bw) (?!.*--count)", "(utime|_m|Hz|bytes).*[0-9]"},
    {"priamos log record ", "lcmlog"},
    {"priamos topic serve ", "http://"},
    {"priamos (view|where)\\b", "."},
    {"priamos link top(?!.*--once)", "LINK_STATUS|CHANNEL|channel"},
    {"(build/bin/)?priamos-teleop .*--show", "PRIAMOS teleop"},
    {"(build/bin/)?priamos-(robot|head|planner|radio|world|console) "
     "(?!.*--(print-config|interface|calibrate|help)\\b)(?!.*&$)",
     "."},
};

const Rule* Find(const std::vector<Rule>& rules, const std::string& command) {
  const auto at = std::find_if(rules.begin(), rules.end(), [&](const Rule& rule) {
    return std::regex_search(command, std::regex("^(sudo )?" + rule.command));
  });
  return at == rules.end() ? nullptr : &*at;
}

std::string Quoted(const std::string& text) {
  return fmt::format("'{}'", std::regex_replace(text, std::regex("'"), "'\\''"));
}

/// Shell functions that say "$ COMMAND", let it print, and say "[exit CODE]".
constexpr const char* kShellFunctions = R"(
finite() { echo "$ $1"; eval "$1" </dev/null; echo "[exit $?]"; }
seen() { sed '1d;/^Script done on/d' .seen 2>/dev/null; }  # `script` adds two lines of its own
# On a terminal of its own, until it has proved itself for a second; then Ctrl-C is typed.
until_stopped() {
  echo "$ $1"
  rm -f .keys .seen; mkfifo .keys
  local screen i keys; exec {keys}<>.keys
  env --default-signal=INT script -qefc "$1" .seen <&$keys >/dev/null & screen=$!
  for ((i = 0; i < 300; i++)); do
    if seen | grep -qE "$2"; then break; fi
    sleep 0.1
  done
  sleep 1; seen | head -c 2000; seen | grep -qE "$2" || echo "[nothing like $2 within 30 s]"
  printf '\003' >&$keys
  wait $screen; echo "[exit $?]"; exec {keys}>&-
}
)";

std::string ScriptOf(const ReadmeBlock& block) {
  std::string script;
  for (const std::string& line : block.commands) {
    // Names in /tmp are shared by everybody on the machine.
    const std::string command = std::regex_replace(line, std::regex("/tmp/"), "$PWD/");
    if (Find(kNotRun, command)) continue;
    const Rule* endless = Find(kUntilStopped, command);
    script += endless ? fmt::format("until_stopped {} {}\n", Quoted(command), Quoted(endless->text))
                      : fmt::format("finite {}\n", Quoted(command));
  }
  return script;
}

/// A copy of the project with the build beside it, and the files that READMEs speak of.
void MakeScratchTree(const fs::path& root) {
  for (const fs::path& file : ProjectFiles()) {
    fs::create_directories((root / file).parent_path());
    fs::copy(PRIAMOS_SOURCE_DIR / file, root / file);
  }
  fs::create_directory_symlink(PRIAMOS_BINARY_DIR, root / "build");
  support::WriteReadmeMaterial(root);
}

/// What went wrong, a sentence each.
std::vector<std::string> Complaints(const std::string& text, std::size_t commands) {
  static const std::regex kBad(R"(\[exit (?!0\]|130\])\d+\]|\[nothing like .*\])"), kEnd(R"(\[exit \d+\])");
  std::vector<std::string> complaints;
  for (std::sregex_iterator at(text.begin(), text.end(), kBad), end; at != end; ++at)
    complaints.push_back(at->str());
  const auto ended = std::distance(std::sregex_iterator(text.begin(), text.end(), kEnd), {});
  if (static_cast<std::size_t>(ended) < commands) complaints.emplace_back("a command did not end");
  return complaints;
}

/// The simulated world refuses to stand in for devices that speak already.
bool StandsInForTheRobot(const ReadmeBlock& block) {
  return std::any_of(block.commands.begin(), block.commands.end(), [](const std::string& command) {
    return command.find("priamos-world ") != std::string::npos;
  });
}

/// Runs a block at most `seconds`; nothing of it lives longer.
std::string RunBlock(const ReadmeBlock& block, int seconds) {
  const TemporaryFolder folder;
  const fs::path tree = folder / "tree";
  MakeScratchTree(tree);
  const std::string script =
      "cd '" + tree.string() + "'; export PATH=$BIN:$PATH\n" +
      fmt::format("for side in {}; do\n", StandsInForTheRobot(block) ? "offboard" : "onboard offboard") +
      "  priamos log play $side.lcmlog --loop --bus $side >/dev/null 2>&1 &\ndone\n" + kShellFunctions +
      ScriptOf(block);
  return RunInPrivateNetwork(script, folder / "script.sh", seconds, "unshare -rnpf --kill-child --mount-proc")
      .text;
}

class ReadmeRun : public ::testing::TestWithParam<ReadmeBlock> {};

TEST_P(ReadmeRun, EveryCommandOfTheBlockWorks) {
  const std::string script = ScriptOf(GetParam());
  const auto commands = static_cast<std::size_t>(std::count(script.begin(), script.end(), '\n'));
  const std::string text = commands == 0 ? "" : RunBlock(GetParam(), 800);
  EXPECT_THAT(Complaints(text, commands), IsEmpty()) << text;
}

std::string NameOf(const ::testing::TestParamInfo<ReadmeBlock>& info) {
  return std::regex_replace(info.param.file.string(), std::regex("[^a-zA-Z]"), "_") +
         std::to_string(info.param.line);
}

INSTANTIATE_TEST_SUITE_P(All, ReadmeRun, ::testing::ValuesIn(ReadmeBlocks()), NameOf);

TEST(ReadmeRunner, ExcusesAreNeeded) {
  for (const Rule& rule : kNotRun) {
    const auto blocks = ReadmeBlocks();
    EXPECT_TRUE(std::any_of(blocks.begin(), blocks.end(),
                            [&](const ReadmeBlock& block) {
                              return std::any_of(block.commands.begin(), block.commands.end(),
                                                 [&](const std::string& command) {
                                                   return Find({rule}, command) != nullptr;
                                                 });
                            }))
        << rule.command << ": no README shows it";
  }
}

TEST(ReadmeRunner, FindsWhatDoesNotWorkAndWhatDoesNotEnd) {
  EXPECT_THAT(
      Complaints(RunBlock({"README.md", 1, {"A=7", "priamos type show pose_t", "test $A = 7"}}, 30), 3),
      IsEmpty());
  const auto text =
      RunBlock({"README.md", 1, {"priamos type show no_such_t", "priamos topic echo POSE", "sleep 99"}}, 20);
  EXPECT_THAT(Complaints(text, 3),
              ::testing::ElementsAre("[exit 2]", ::testing::AnyOf("[exit 143]", "a command did not end")))
      << text;
}

}  // namespace
}  // namespace priamos
