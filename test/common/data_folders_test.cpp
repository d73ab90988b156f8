#include "common/data_folders.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Paths = std::vector<fs::path>;

ProgramPlace Installed() {
  ProgramPlace place;
  place.program_folder = "/opt/a prefix/bin";
  place.home = "/home/ada";
  return place;
}

TEST(DataFolders, AnInstalledProgramLooksAroundItself) {
  EXPECT_THAT(DeploymentRoots(Installed()),
              ElementsAre("/home/ada/.config/priamos", "/etc/xdg/priamos", "/opt/a prefix/etc/priamos",
                          "/opt/a prefix/share/priamos/config"));
}

TEST(DataFolders, ARobotHasItsConfigurationInEtc) {
  auto place = Installed();
  place.program_folder = "/usr/bin";
  EXPECT_THAT(DeploymentRoots(place), testing::Contains(fs::path("/etc/priamos")));
  EXPECT_EQ(SystemConfigFolder("/usr/local"), "/usr/local/etc");
}

TEST(DataFolders, AProgramOfABuildFolderBelongsToItsClone) {
  auto place = Installed();
  place.program_folder = "/src/priamos/build/bin";
  place.clone = "/src/priamos";
  EXPECT_EQ(DeploymentRoots(place).back(), "/src/priamos/config");
  EXPECT_EQ(LogFolder(place), "/src/priamos/logs");
}

TEST(DataFolders, TheEnvironmentGoesFirst) {
  auto place = Installed();
  place.data = "/data";
  place.config_home = "/c";
  place.config_dirs = "/d:relative:/e";
  auto roots = DeploymentRoots(place);
  roots.resize(4);
  EXPECT_THAT(roots, ElementsAre("/data/config", "/c/priamos", "/d/priamos", "/e/priamos"));
}

TEST(DataFolders, ARelativeXdgFolderDoesNotCount) {
  auto place = Installed();
  place.config_home = "c";
  place.state_home = "s";
  EXPECT_EQ(DeploymentRoots(place).front(), "/home/ada/.config/priamos");
  EXPECT_EQ(LogFolder(place), "/home/ada/.local/state/priamos");
}

TEST(DataFolders, LogsFollowXdgAndNeedAHome) {
  auto place = Installed();
  place.state_home = "/var/state";
  EXPECT_EQ(LogFolder(place), "/var/state/priamos");
  place.clone = "/src";
  place.logs = "/mnt/logs";
  EXPECT_EQ(LogFolder(place), "/mnt/logs");
  EXPECT_THROW(LogFolder(ProgramPlace()), ConfigError);
}

/// Deployments on the disk: `sim` and `robot` were installed, the user has a `sim` of his own.
class FindDeploymentTest : public testing::Test {
 protected:
  FindDeploymentTest() {
    place_.program_folder = folder_ / "bin";
    place_.home = folder_ / "home";
    Make("share/priamos/config/sim");
    Make("share/priamos/config/robot");
    Make("home/.config/priamos/sim");
  }
  void Make(const std::string& deployment) {
    fs::create_directories(folder_ / deployment);
    std::ofstream(folder_ / (deployment + "/deployment.toml")) << "title = \"x\"\n";
  }
  std::string Refusal(const std::string& given) const {
    try {
      return "found " + FindDeployment(given, place_);
    } catch (const ConfigError& error) {
      return error.what();
    }
  }
  TemporaryFolder folder_;
  ProgramPlace place_;
};

TEST_F(FindDeploymentTest, TheUsersOwnOverridesWhatWasInstalled) {
  EXPECT_EQ(FindDeployment("sim", place_), (folder_ / "home/.config/priamos/sim"));
  EXPECT_EQ(FindDeployment("robot", place_), (folder_ / "share/priamos/config/robot"));
}

TEST_F(FindDeploymentTest, APathIsTakenAsItIs) {
  const std::string path = folder_ / "share/priamos/config/sim";
  EXPECT_EQ(FindDeployment(path, place_), path);
  EXPECT_THAT(Refusal(path + "x"), HasSubstr("simx: expected the folder of a deployment"));
}

TEST_F(FindDeploymentTest, AnUnknownNameIsAnsweredWithTheKnownOnesAndThePlaces) {
  const std::string refusal = Refusal("robto");
  EXPECT_THAT(refusal, HasSubstr("one of robot, sim"));
  EXPECT_THAT(refusal, HasSubstr("got \"robto\"; nearest: \"robot\""));
  for (const auto& root : DeploymentRoots(place_)) EXPECT_THAT(refusal, HasSubstr(root.string()));
  EXPECT_THAT(Refusal(""), HasSubstr("got \"\""));
}

TEST(DataFolders, AFolderOfDataWithoutConfigurationIsNamed) {
  ProgramPlace place;
  place.data = "/nowhere";
  EXPECT_THAT([&] { FindDeployment("sim", place); },
              testing::ThrowsMessage<ConfigError>(testing::HasSubstr("PRIAMOS_DATA: expected a folder")));
}

TEST(DataFolders, WhereNoDeploymentIsFoundThePlacesAreNamed) {
  EXPECT_THAT([] { FindDeployment("sim", Installed()); },
              testing::ThrowsMessage<ConfigError>(
                  AllOf(HasSubstr("got \"sim\"; none was found in /home/ada/.config/priamos, "),
                        Not(HasSubstr("one of ")))));
}

TEST(ShownFrom, IsShortBelowAndWholeElsewhere) {
  EXPECT_EQ(ShownFrom("/a/b", "/a/b/logs/x"), "logs/x");
  EXPECT_EQ(ShownFrom("/a/b", "/a/c"), "/a/c");
}

TEST(ThisProgram, OfATestRunsFromItsClone) {
  const auto place = ThisProgram();
  EXPECT_EQ(place.program_folder, PRIAMOS_BINARY_DIR "/bin");
  EXPECT_EQ(place.clone, PRIAMOS_SOURCE_DIR);
}

}  // namespace
}  // namespace priamos
