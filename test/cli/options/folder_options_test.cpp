#include "cli/options/folder_options.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

TEST(FolderOptions, ADeploymentIsTheOneThatWasGivenBeforeUnlessNamed) {
  CLI::App verb;
  std::string deployment = "sim", logs;
  AddDeploymentOption(verb, deployment);
  AddLogsOption(verb, logs, "runs");
  verb.parse("", false);
  EXPECT_EQ(deployment, "sim");
  EXPECT_EQ(logs, "");
  verb.parse("--deployment robot --logs /tmp/here", false);
  EXPECT_EQ(deployment, "robot");
  EXPECT_EQ(logs, "/tmp/here");
}

TEST(FolderOptions, AFolderWithASlashIsTakenAsItIs) {
  TemporaryFolder folder;
  std::ofstream(folder / "deployment.toml").close();
  EXPECT_TRUE(std::filesystem::equivalent(FolderOfDeployment(folder.path().string() + "/"), folder.path()));
}

TEST(FolderOptions, ANameIsLookedForInTheFolderOfTheEnvironmentFirst) {
  TemporaryFolder data;
  std::filesystem::create_directories(data / "config/sim");
  std::ofstream(data / "config/sim/deployment.toml").close();
  setenv("PRIAMOS_DATA", data.path().c_str(), 1);
  const std::string found = FolderOfDeployment("sim");
  unsetenv("PRIAMOS_DATA");
  EXPECT_TRUE(std::filesystem::equivalent(found, data / "config/sim")) << found;
}

TEST(FolderOptions, AnUnknownDeploymentIsRefusedWithTheNearest) {
  try {
    FolderOfDeployment("robott");
    FAIL() << "it was found";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("robott"), HasSubstr("\"robot\"")));
  }
}

TEST(FolderOptions, RunsAreWrittenWhereTheWordSaysElseTheEnvironment) {
  setenv("PRIAMOS_LOGS", "/tmp/of-the-environment", 1);
  EXPECT_EQ(LogRoot("/tmp/of-the-word"), "/tmp/of-the-word");
  EXPECT_EQ(LogRoot(""), "/tmp/of-the-environment");
  unsetenv("PRIAMOS_LOGS");
}

TEST(FolderOptions, AFolderOfARunIsNamedByItsTimeAndWhatItIs) {
  TemporaryFolder logs;
  const std::filesystem::path dut = MakeRunFolder(logs.path() / "new", "up-sim");
  EXPECT_TRUE(std::filesystem::is_directory(dut));
  EXPECT_EQ(dut.parent_path(), logs.path() / "new");
  EXPECT_THAT(dut.filename().string(), testing::MatchesRegex("[0-9]{8}-[0-9]{6}-up-sim"));
}

}  // namespace
}  // namespace priamos::cli
