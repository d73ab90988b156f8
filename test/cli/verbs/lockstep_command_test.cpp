#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "test/cli/priamos_answer.hpp"
#include "test/cli/small_deployment.hpp"

// `lockstep` and `run`, as far as they go without a process: whole runs are in test/system.

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class LockstepCommand : public testing::Test {
 protected:
  PriamosAnswer Lockstep(std::vector<std::string> more) {
    std::vector<std::string> words{"lockstep", "--deployment", deployment_.name(), "--scenario", "wait"};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  SmallDeployment deployment_;
};

TEST_F(LockstepCommand, ARunThatHasNotPassedIsExitCodeOneWithItsReason) {
  const auto answer = Lockstep({"--seed", "5"});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(LinesOf(answer.out).at(0),
              AllOf(StartsWith("seed 5      FAILED  contacts 0"), HasSubstr("x  ")));
}

TEST_F(LockstepCommand, SeveralRunsHaveALineEachAndTheNextSeed) {
  const auto lines = LinesOf(Lockstep({"--seed", "7", "--runs", "3"}).out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(lines, ElementsAre(StartsWith("seed 7 "), StartsWith("seed 8 "), StartsWith("seed 9 "),
                                 "0 of 3 passed, 0 contacts"));
}

TEST_F(LockstepCommand, JsonOfOneRunIsADocumentAndOfSeveralAnArray) {
  const auto one = Lockstep({"--json"});
  EXPECT_EQ(json::parse(one.out).at("scenario"), "wait");
  EXPECT_THAT(one.err, StartsWith("seed 1 ")) << "for a person, on standard error";
  const auto two = json::parse(Lockstep({"--json", "-", "--runs", "2"}).out);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[1].at("seed"), 2);
}

TEST_F(LockstepCommand, JsonIntoAFileLeavesStandardOutputToPeople) {
  const std::string file = deployment_ / "runs.json";
  const auto answer = Lockstep({"--json", file});
  EXPECT_THAT(answer.out, StartsWith("seed 1 "));
  EXPECT_EQ(json::parse(FileContent(file)).at("passed"), false);
}

TEST_F(LockstepCommand, AFileThatCannotBeWrittenIsNamed) {
  const auto answer = Lockstep({"--json", "/no/such/folder/runs.json"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("/no/such/folder/runs.json: cannot be written"));
}

TEST_F(LockstepCommand, LogsAndReportOfEveryRunHaveAFolderPerSeed) {
  EXPECT_EQ(Lockstep({"--seed", "3", "--logs", deployment_ / "logs"}).exit_code, 1);
  for (const char* name : {"onboard.lcmlog", "offboard.lcmlog", "summary.json", "report.html", "run.svg"})
    EXPECT_TRUE(std::filesystem::exists(deployment_ / "logs/seed-3" / name)) << name;
}

TEST_F(LockstepCommand, WhatCannotBeRunIsRefused) {
  const auto scenario = Priamos({"lockstep", "--deployment", deployment_.name(), "--scenario", "weit"});
  EXPECT_EQ(scenario.exit_code, 2);
  EXPECT_THAT(scenario.err, HasSubstr("nearest: \"wait\""));
  for (const char* runs : {"0", "-3", "many"}) {
    const auto answer = Lockstep({"--runs", runs});
    EXPECT_EQ(answer.exit_code, 2) << runs;
    EXPECT_THAT(answer.err, AllOf(HasSubstr("--runs: expected a"), HasSubstr(runs)));
  }
}

TEST_F(LockstepCommand, RunRefusesAnUnknownScenarioBeforeItMakesAFolder) {
  const std::string logs = deployment_ / "logs";
  const auto answer =
      Priamos({"run", "--deployment", deployment_.name(), "--scenario", "weit", "--logs", logs});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(StartsWith("priamos run: "), HasSubstr("nearest: \"wait\"")));
  EXPECT_FALSE(std::filesystem::exists(logs));
}

TEST_F(LockstepCommand, RunRefusesADoorThatTheMapLacks) {
  deployment_.AddScenario("elsewhere", "");
  std::ofstream(deployment_ / "scenarios/elsewhere.toml") << "landmark_id = 77\nmap = \"maps/door.toml\"\n";
  const auto answer = Priamos(
      {"run", "--deployment", deployment_.name(), "--scenario", "elsewhere", "--logs", deployment_ / "l"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("maps/door.toml"), HasSubstr("77")));
}

}  // namespace
}  // namespace priamos::cli
