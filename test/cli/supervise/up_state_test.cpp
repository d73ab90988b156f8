#include "cli/supervise/up_state.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

UpState TwoProcesses() {
  UpState state;
  state.deployment = "config/sim";
  state.config_folder = "/opt/config/sim";
  state.planner_set = "map=maps/hall.toml";
  state.folder = "/tmp/consoles";
  state.ready = true;
  state.up_s = 61.4;
  state.ages_s = {3.25, 0.5};
  state.alarms = {"ALARM (caution) of head: dark"};
  ProcessReport robot;
  robot.name = "onboard-robot";
  robot.group = "onboard";
  robot.state = ProcessState::kReady;
  robot.pid = 4711;
  robot.starts = 2;
  ProcessReport planner;
  planner.name = "offboard-planner";
  planner.state = ProcessState::kBackOff;
  planner.starts = 4;
  planner.alarm = true;
  planner.reason = "signal 11";
  state.processes = {robot, planner};
  return state;
}

std::string Refusal(const std::string& folder) {
  try {
    const UpLock lock(folder);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

class UpStateTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(UpStateTest, WhatWasWrittenIsRead) {
  const UpState state = TwoProcesses();
  WriteUpState(folder_.path(), state);
  const auto dut = ReadUpState(folder_.path());
  ASSERT_TRUE(dut);
  EXPECT_EQ(ToJson(*dut), ToJson(state));
  EXPECT_EQ(dut->processes[1].state, ProcessState::kBackOff);
  EXPECT_EQ(dut->processes[1].reason, "signal 11");
}

TEST_F(UpStateTest, EveryStateSurvivesTheFile) {
  for (const ProcessState state : {ProcessState::kWaiting, ProcessState::kStarting, ProcessState::kReady,
                                   ProcessState::kBackOff, ProcessState::kStopping, ProcessState::kStopped}) {
    UpState written = TwoProcesses();
    written.processes[0].state = state;
    WriteUpState(folder_.path(), written);
    EXPECT_EQ(ReadUpState(folder_.path())->processes[0].state, state) << Text(state);
  }
}

TEST_F(UpStateTest, AReasonThatIsNoTextDoesNotSpoilTheFile) {
  UpState state = TwoProcesses();
  state.processes[1].reason = "caf\xe9";
  WriteUpState(folder_.path(), state);
  EXPECT_TRUE(ReadUpState(folder_.path()));
}

TEST_F(UpStateTest, WhatCannotBeReadIsNone) {
  EXPECT_FALSE(ReadUpState(folder_.path())) << "nothing there";
  const std::string whole = ToJson(TwoProcesses()).dump();
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{}"), whole.substr(0, whole.size() / 2),
        std::string(R"({"deployment":1,"folder":2,"ready":3,"up_s":4})")}) {
    std::ofstream(folder_ / "up.json") << text;
    EXPECT_FALSE(ReadUpState(folder_.path())) << text;
  }
}

TEST_F(UpStateTest, NothingIsLeftAsideOfTheFile) {
  WriteUpState(folder_.path(), TwoProcesses());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "up.json.new"));
}

TEST_F(UpStateTest, TheTableNamesStatesPidsAndWhyAProcessEnded) {
  const auto lines = LinesOf(FormatUpState(TwoProcesses(), std::nullopt));
  ASSERT_THAT(lines, SizeIs(6));
  EXPECT_EQ(lines[0], "config/sim: ready, up for 61 s; consoles in /tmp/consoles");
  EXPECT_THAT(lines[2], AllOf(StartsWith("onboard-robot"), HasSubstr("4711"), HasSubstr("3.2 s")));
  EXPECT_THAT(lines[3], AllOf(StartsWith("offboard-planner"), HasSubstr(" - "))) << "it has no pid";
  EXPECT_EQ(lines[4], "ALARM offboard-planner last ended: signal 11");
  EXPECT_EQ(lines[5], "ALARM (caution) of head: dark");
}

TEST_F(UpStateTest, ANarrowTerminalIsNotOverrun) {
  for (int columns = 20; columns <= 100; columns += 8) {
    const auto lines = LinesOf(FormatUpState(TwoProcesses(), ScreenSize{columns, 1000}));
    EXPECT_THAT(lines, Each(SizeIs(testing::Le(static_cast<std::size_t>(columns))))) << columns;
  }
}

TEST_F(UpStateTest, OneUpPerFolder) {
  const std::string root = folder_ / "logs";
  EXPECT_FALSE(UpLock::Holder(root)) << "no folder yet";
  {
    const UpLock lock(root);
    EXPECT_EQ(UpLock::Holder(root), getpid());
    EXPECT_EQ(UpLock::FolderOf(getpid()), root);
    EXPECT_EQ(Refusal(root), fmt::format("{}: expected nothing up, got `priamos up` with pid {}: `priamos "
                                         "down` ends it",
                                         root, getpid()));
    EXPECT_EQ(UpLock::Holder(root), getpid()) << "the refusal has not let go of it";
  }
  EXPECT_FALSE(UpLock::Holder(root)) << "the file is still there, and nobody holds it";
  EXPECT_FALSE(UpLock::FolderOf(getpid()));
  EXPECT_EQ(Refusal(root), "");
}

TEST_F(UpStateTest, ANewUpForgetsTheStateOfOneThatWasKilled) {
  WriteUpState(folder_.path(), TwoProcesses());
  const UpLock lock(folder_.path());
  EXPECT_FALSE(ReadUpState(folder_.path()));
}

TEST_F(UpStateTest, ALockThatCannotBeOpenedIsNotTakenForAnotherUp) {
  std::filesystem::create_directory(folder_ / "up.lock");
  const std::string why = Refusal(folder_.path());
  EXPECT_THAT(why, HasSubstr("up.lock: cannot be written"));
  EXPECT_THAT(why, Not(HasSubstr("pid")));
}

TEST_F(UpStateTest, AnUnknownProcessHoldsNoFolder) {
  EXPECT_FALSE(UpLock::FolderOf(1 << 22));
}

TEST_F(UpStateTest, AStateThatCannotBeWrittenLeavesTheOldOne) {
  ASSERT_TRUE(WriteUpState(folder_.path(), TwoProcesses()));
  std::filesystem::create_directory(folder_ / "up.json.new");  // in the way of the write
  UpState next = TwoProcesses();
  next.up_s = 99;
  EXPECT_FALSE(WriteUpState(folder_.path(), next));
  EXPECT_EQ(ReadUpState(folder_.path()).value().up_s, 61.4);
}

}  // namespace
}  // namespace priamos::cli
