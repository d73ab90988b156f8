#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/cli/priamos_answer.hpp"
#include "test/cli/small_deployment.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(LockstepCommand, WhatCannotBeWrittenIsFoundOutBeforeTheFirstRun) {
  TemporaryFolder folder;
  const std::string file = folder / "file";
  std::ofstream(file) << "kept";
  const auto json = Priamos({"lockstep", "--json", folder / "no-such-folder/runs.json"});
  EXPECT_EQ(json.exit_code, 2);
  EXPECT_THAT(json.err, AllOf(HasSubstr("--json: expected a file that can be written, got \""),
                              HasSubstr("No such file or directory")));
  EXPECT_EQ(json.out, "") << "no run";
  for (const std::string& logs : {file + "/logs", std::string("/proc/no-such-folder")}) {
    const auto answer = Priamos({"lockstep", "--logs", logs});
    EXPECT_EQ(answer.exit_code, 2) << logs;
    EXPECT_THAT(answer.err, StartsWith("priamos lockstep: " + logs)) << logs;
    EXPECT_EQ(answer.out, "") << "no run";
  }
  EXPECT_EQ(FileContent(file), "kept");
}

TEST(LockstepCommand, ADeploymentWithoutScenariosNamesOneThatHasSome) {
  const auto answer = Priamos({"lockstep", "--deployment", "robot"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("it has no scenarios"), HasSubstr("--deployment sim")));
}

TEST(LockstepCommand, AScenarioWithoutProcessesIsRefused) {
  const SmallDeployment deployment;
  const auto answer = Priamos({"lockstep", "--deployment", deployment.name(), "--scenario", "wait"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("scenario wait: expected a [[process]] that runs in simulated time"));
}

}  // namespace
}  // namespace priamos::cli
