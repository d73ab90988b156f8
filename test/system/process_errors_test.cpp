#include <gmock/gmock.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// What a person gets for something that cannot be used: one sentence, exit code 2, nothing half started.

namespace priamos {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string Binary(const std::string& name) {
  return std::string(PRIAMOS_BINARY_DIR) + "/bin/" + name;
}
std::string Config(const std::string& name) {
  return std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/" + name;
}

/// Runs a command in a network of its own, at most 10 s.
ShellAnswer RunCommand(
    const std::string& command,
    const std::string& network = "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo") {
  return RunShell("timeout 10 unshare -rn sh -c '" + network + "; " + command + "'");
}

class ProcessErrors : public testing::TestWithParam<const char*> {
 protected:
  std::string name() const { return GetParam(); }
  std::string process() const { return Binary("priamos-" + name()); }
};

void ExpectOneSentence(const ShellAnswer& answer) {
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
}

TEST_P(ProcessErrors, MissingConfigurationFile) {
  const auto answer = RunCommand(process() + " --config /nowhere/x.toml");
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, HasSubstr("/nowhere/x.toml: expected a configuration file, got none"));
}

TEST_P(ProcessErrors, UnknownKeyOnTheCommandLine) {
  const auto answer =
      RunCommand(process() + " --config " + Config(name() + ".toml") + " --set no_such_key=1");
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, HasSubstr("no_such_key: expected a known key"));
}

TEST_P(ProcessErrors, UnknownKeyInAFile) {
  const TemporaryFolder folder;
  const auto file = folder / "unknown.toml";
  std::ofstream(file) << "\nno_such_key = 1\n";
  const auto answer = RunCommand(process() + " --config " + file.string());
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, HasSubstr(file.string() + ":2:no_such_key"));
}

TEST_P(ProcessErrors, BusWithoutMulticast) {
  const auto answer = RunCommand(process() + " --config " + Config(name() + ".toml"), "ip link set lo up");
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text,
              AllOf(HasSubstr("expected a multicast route"), HasSubstr("ip route add 224.0.0.0/4 dev lo")));
}

TEST_P(ProcessErrors, PrintedConfigurationIsTheOneThatRuns) {
  const auto answer = RunCommand(process() + " --config " + Config(name() + ".toml") + " --print-config");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("# ["));
}

TEST_P(ProcessErrors, NoModuleListensToTheTruth) {
  const auto answer = RunCommand(process() + " --config " + Config(name() + ".toml") + " --interface");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("out  HEALTH"));
  EXPECT_THAT(answer.text, Not(HasSubstr("in   WORLD_TRUTH")));
}

INSTANTIATE_TEST_SUITE_P(EveryProcess, ProcessErrors,
                         testing::Values("world", "robot", "head", "planner", "radio"),
                         [](const auto& info) { return std::string(info.param); });

TEST(RadioProcess, AbsentTtyNamesTheNextStep) {
  const auto answer =
      RunCommand(Binary("priamos-radio") + " --config " + Config("radio.toml") + " --port /dev/no-such-tty");
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, HasSubstr("/dev/no-such-tty"));
}

TEST(RadioProcess, ALoopOfLinksIsNoPort) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("b", folder.path() / "a");
  std::filesystem::create_symlink("a", folder.path() / "b");
  const auto answer = RunCommand(Binary("priamos-radio") + " --config " + Config("radio.toml") + " --port " +
                                 (folder / "a").string());
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, HasSubstr("its symbolic links lead to each other"));
}

TEST(RadioProcess, TheKeyThatEverybodyKnowsStaysOnThisMachine) {
  const TemporaryFolder folder;
  std::ofstream(folder / "link.toml") << "simulation_key = true\ndatagrams = true\n"
                                         "[[channel]]\nname = \"POSE\"\ntype = \"pose_t\"\ndirection = "
                                         "\"up\"\nclass = \"state\"\n";
  const auto answer = RunCommand(Binary("priamos-radio") + " --config " + (folder / "link.toml").string() +
                                 " --port udp:192.0.2.1:9000");
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, HasSubstr("link.toml:1:simulation_key: expected false on \"udp:192.0.2.1:9000\""));
  EXPECT_THAT(answer.text, HasSubstr("priamos link keygen"));
}

TEST(PriamosRun, UnknownScenarioIsAnsweredWithTheKnownOnes) {
  const auto answer = RunCommand(Binary("priamos") + " run --scenario nothing --deployment " + Config(""));
  ExpectOneSentence(answer);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("\"nothing\""), HasSubstr("door")));
}

}  // namespace
}  // namespace priamos
