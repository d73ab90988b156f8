#include "cli/verbs/deployment/up_queries.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A folder of logs as a `priamos up` with two processes leaves it.
class UpQueries : public testing::Test {
 protected:
  UpQueries() {
    state_.deployment = "config/sim";
    state_.folder = folder_.path();
    state_.ready = true;
    for (const char* name : {"onboard-robot", "offboard-planner"}) {
      ProcessReport report;
      report.name = name;
      report.state = ProcessState::kReady;
      report.pid = 4711;
      report.starts = 1;
      state_.processes.push_back(report);
      state_.ages_s.push_back(12.5);
    }
    WriteUpState(folder_.path(), state_);
  }
  PriamosAnswer Ask(std::vector<std::string> words) {
    words.insert(words.end(), {"--logs", folder_.path()});
    return Priamos(words);
  }
  void WriteConsole(const std::string& process, int lines) {
    std::ofstream out(folder_ / (process + ".txt"));
    for (int i = 1; i <= lines; ++i) out << "line " << i << "\n";
  }
  TemporaryFolder folder_;
  UpState state_;
};

TEST_F(UpQueries, LogsAreTheLastLinesOfEveryConsole) {
  WriteConsole("onboard-robot", 30);
  WriteConsole("offboard-planner", 2);
  const auto lines = LinesOf(Ask({"logs"}).out);
  ASSERT_EQ(lines.size(), 20u + 2u) << "twenty of each";
  EXPECT_EQ(lines[0], "onboard-robot      line 11");
  EXPECT_EQ(lines[19], "onboard-robot      line 30");
  EXPECT_EQ(lines[21], "offboard-planner   line 2");
}

TEST_F(UpQueries, LogsOfOneProcessAndOfSoManyLines) {
  WriteConsole("onboard-robot", 30);
  EXPECT_THAT(LinesOf(Ask({"logs", "onboard-robot", "-n", "2"}).out),
              ElementsAre("onboard-robot      line 29", "onboard-robot      line 30"));
  EXPECT_EQ(Ask({"logs", "-n", "0"}).out, "");
}

TEST_F(UpQueries, LogsAsJsonHaveAnEntryPerProcess) {
  WriteConsole("onboard-robot", 3);
  const auto dut = json::parse(Ask({"logs", "--json", "-n", "1"}).out);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_EQ(dut[0], json({{"process", "onboard-robot"}, {"lines", {"line 3"}}}));
  EXPECT_THAT(dut[1].at("lines"), IsEmpty()) << "it said nothing";
}

TEST_F(UpQueries, AConsoleWithBytesThatAreNoTextIsStillJson) {
  std::ofstream(folder_ / "onboard-robot.txt", std::ios::binary) << "caf\xe9\n";
  EXPECT_THAT(json::parse(Ask({"logs", "--json"}).out)[0].at("lines")[0].get<std::string>(),
              HasSubstr("caf"));
}

TEST_F(UpQueries, LogsOfAnUnknownProcessNameTheNearest) {
  const auto answer = Ask({"logs", "onboard-robots"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(
      answer.err,
      "priamos logs: unknown process \"onboard-robots\"; nearest: \"onboard-robot\" (priamos status lists "
      "all)\n");
}

TEST_F(UpQueries, WhereNothingWasEverUpThereAreNoLogs) {
  std::filesystem::remove(folder_ / "up.json");
  EXPECT_EQ(Ask({"logs"}).exit_code, 1);
  EXPECT_EQ(Ask({"logs"}).out, "nothing was ever up\n");
  EXPECT_EQ(Ask({"logs", "--json"}).out, "[]\n");
}

TEST_F(UpQueries, ANumberOfLinesBelowZeroIsRefused) {
  const auto answer = Ask({"logs", "-n", "-1"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("-n: expected"));
}

/// The lock is this process's, so something is up as far as `status` can see.
TEST_F(UpQueries, StatusOfWhatIsReadyIsExitCodeZero) {
  const UpLock lock(folder_.path());
  WriteUpState(folder_.path(), state_);
  const auto answer = Ask({"status"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("config/sim: ready"), HasSubstr("onboard-robot"), HasSubstr("4711"),
                                HasSubstr("12.5 s")));
}

TEST_F(UpQueries, StatusOfWhatIsNotReadyIsExitCodeOneAndJsonSaysWhy) {
  const UpLock lock(folder_.path());
  state_.ready = false;
  state_.processes[1].state = ProcessState::kBackOff;
  state_.processes[1].reason = "exit code 2";
  WriteUpState(folder_.path(), state_);
  const auto answer = Ask({"status", "--json"});
  EXPECT_EQ(answer.exit_code, 1);
  const auto dut = json::parse(answer.out);
  EXPECT_EQ(dut.at("up"), true);
  EXPECT_EQ(dut.at("ready"), false);
  EXPECT_EQ(dut.at("processes")[1].at("reason"), "exit code 2");
}

TEST_F(UpQueries, ShowIsATableOrOneDocument) {
  testing::internal::CaptureStdout();
  Show(state_, true);
  EXPECT_EQ(json::parse(testing::internal::GetCapturedStdout()).at("deployment"), "config/sim");
  testing::internal::CaptureStdout();
  Show(state_, false);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("process"));
}

/// What `up` refuses before it starts anything.
TEST(UpCommand, AnUnknownDeploymentIsRefusedWithTheKnownOnes) {
  TemporaryFolder folder;
  const auto answer = Priamos({"up", "simm", "--logs", folder.path()});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("simm"), HasSubstr("nearest: \"sim\"")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "nothing was begun";
}

TEST(UpCommand, AFolderWithoutADeploymentIsRefused) {
  TemporaryFolder folder;
  const auto answer = Priamos({"up", folder.path().string() + "/", "--logs", folder / "logs"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("deployment.toml"));
  EXPECT_FALSE(std::filesystem::exists(folder / "logs"));
}

TEST(UpCommand, AGroupIsOneOfThree) {
  const auto answer = Priamos({"up", "sim", "--group", "onbord"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("--group: expected one of all, onboard, offboard"),
                                HasSubstr("nearest: \"onboard\"")));
}

TEST(UpCommand, ASeedIsAWholeNumberFromZero) {
  for (const char* seed : {"-1", "1.5", "one", "18446744073709551616"}) {
    const auto answer = Priamos({"up", "sim", "--seed", seed});
    EXPECT_EQ(answer.exit_code, 2) << seed;
    EXPECT_THAT(answer.err, AllOf(HasSubstr("--seed: expected a"), HasSubstr(seed)));
  }
}

}  // namespace
}  // namespace priamos::cli
