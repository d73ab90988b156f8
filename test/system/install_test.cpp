// What `cmake --install` puts where: everything below the prefix, configuration that survives the next
// installation, units that systemd takes; and what `uninstall` leaves.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "test/system/installed_test.hpp"

namespace priamos {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class InstallTest : public InstalledTest {
 protected:
  fs::path At(const std::string& file) const { return installed_.prefix() / file; }
  std::string TextAt(const std::string& file) const { return Installation::TextOf(At(file)); }
  std::vector<std::string> Files() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(installed_.prefix()))
      if (!entry.is_directory()) files.push_back(fs::relative(entry.path(), installed_.prefix()).string());
    return files;
  }
};

/// That nothing is written elsewhere is seen by everything else being read-only.
TEST_F(InstallTest, EverythingIsBelowThePrefix) {
  const auto files = Files();
  for (const char* file : {"bin/priamos",
                           "bin/priamos-verbs",
                           "bin/priamos-log",
                           "bin/priamos-world",
                           "bin/priamos-robot",
                           "bin/priamos-head",
                           "bin/priamos-planner",
                           "bin/priamos-console",
                           "bin/priamos-teleop",
                           "bin/priamos-radio",
                           "bin/priamos-spy",
                           "bin/priamos-logplayer",
                           "share/priamos/config/sim/deployment.toml",
                           "share/priamos/config/sim/scenarios/door.toml",
                           "share/priamos/config/sim/kastor.yaml",
                           "share/priamos/config/robot/deployment.toml",
                           "etc/priamos/robot/robot.toml",
                           "share/priamos/lcmtypes/pose_t.lcm",
                           "share/bash-completion/completions/priamos",
                           "share/zsh/site-functions/_priamos",
                           "share/fish/vendor_completions.d/priamos.fish",
                           "share/man/man1/priamos.1",
                           "share/man/man1/priamos-topic.1",
                           "share/man/man1/priamos-robot.1",
                           "share/man/man5/priamos-deployment.5",
                           "share/doc/priamos/runtime-packages",
                           "lib/systemd/system/priamos@.service",
                           "lib/systemd/system/priamos.target",
                           "lib/sysusers.d/priamos.conf"})
    EXPECT_THAT(files, Contains(file));
  const std::string cache = Installation::TextOf(PRIAMOS_BINARY_DIR "/CMakeCache.txt");
  if (cache.find("\nPRIAMOS_JAVA:BOOL=ON\n") != std::string::npos) {
    EXPECT_THAT(files, Contains("share/priamos/java/priamos-spy.jar"));
  }
  // Every one is in the list that uninstall goes by.
  const std::string manifest = Installation::TextOf(installed_.folder() / "install_manifest.txt");
  for (const auto& file : files) EXPECT_THAT(manifest, HasSubstr(At(file).string()));
}

TEST_F(InstallTest, TheWholeSimulatedDeploymentIsThere) {
  for (const auto& entry : fs::recursive_directory_iterator(PRIAMOS_SOURCE_DIR "/config/sim")) {
    const auto extension = entry.path().extension();
    if (extension != ".toml" && extension != ".yaml") continue;
    const fs::path file = fs::relative(entry.path(), PRIAMOS_SOURCE_DIR "/config");
    EXPECT_EQ(TextAt("share/priamos/config/" + file.string()), Installation::TextOf(entry.path())) << file;
  }
}

TEST(InstallWhileEditing, WhatAnEditorLeavesBesideAFileStaysWhereItIs) {
  const Installation installed;
  const auto answer = installed.InstallWhileEditing();
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(fs::exists(installed.prefix() / "share/priamos/config/sim/world.toml")) << answer.text;
  for (const auto& entry : fs::recursive_directory_iterator(installed.prefix())) {
    const std::string name = entry.path().filename();
    EXPECT_FALSE(name.starts_with('.') || name.starts_with('#') || name.ends_with('~')) << entry.path();
  }
}

TEST_F(InstallTest, EverybodyMayReadItWhateverTheUmask) {
  for (const auto& entry : fs::recursive_directory_iterator(installed_.prefix())) {
    const auto needed =
        fs::perms::others_read | (entry.is_directory() ? fs::perms::others_exec : fs::perms());
    EXPECT_EQ(entry.status().permissions() & needed, needed) << entry.path();
  }
}

TEST_F(InstallTest, TheUnitNamesTheProgramsWhereTheyAre) {
  const std::string unit = TextAt("lib/systemd/system/priamos@.service");
  EXPECT_THAT(unit, HasSubstr("ExecStart=\"" + At("bin/priamos-%i").string() + "\" --config \"" +
                              At("etc/priamos/robot/%i.toml").string() + "\" --bus"));
  EXPECT_THAT(unit, HasSubstr("EnvironmentFile=-" + At("etc/priamos/priamos.env").string() + "\n"));
  for (const char* line : {"Type=notify", "WatchdogSec=", "Restart=always", "NoNewPrivileges=yes",
                           "CapabilityBoundingSet=\n", "ProtectSystem=strict", "SystemCallFilter="})
    EXPECT_THAT(unit, HasSubstr(line));
  EXPECT_THAT(TextAt("lib/systemd/system/priamos.target"), HasSubstr("[Install]"));
  EXPECT_THAT(TextAt("lib/sysusers.d/priamos.conf"), HasSubstr("u priamos"));
}

TEST_F(InstallTest, SystemdTakesTheUnits) {
  if (RunShell("systemd-analyze --version").exit_code != 0) GTEST_SKIP() << "no systemd-analyze here";
  const std::string file = installed_.folder() / "priamos@robot.service";
  fs::copy(At("lib/systemd/system/priamos@.service"), file);
  const auto taken = RunShell("systemd-analyze verify --man=no " + file);
  EXPECT_EQ(taken.exit_code, 0);
  EXPECT_EQ(taken.text, "");
  const auto secure = RunShell("systemd-analyze security --offline=true --threshold=25 " + file);
  EXPECT_EQ(secure.exit_code, 0) << secure.text;
}

TEST_F(InstallTest, AnInstallationKeepsWhatWasChangedOnTheRobot) {
  std::ofstream(At("etc/priamos/robot/robot.toml")) << "# mine\n";
  fs::remove(At("etc/priamos/robot/link.toml"));
  EXPECT_THAT(installed_.Install().text, HasSubstr("Kept: "));
  EXPECT_EQ(TextAt("etc/priamos/robot/robot.toml"), "# mine\n");
  EXPECT_TRUE(fs::exists(At("etc/priamos/robot/link.toml"))) << "what is missing comes back";
}

TEST_F(InstallTest, ThePackagesOfARuntimeAreNamedAndNoneIsForDevelopment) {
  const std::string packages = TextAt("share/doc/priamos/runtime-packages");
  for (const char* package : {"libc6\n", "liblcm1\n", "libmrpt-opengl", "libopencv-core", "libegl1\n"})
    EXPECT_THAT(packages, HasSubstr(package));
  EXPECT_THAT(packages, Not(HasSubstr("-dev\n")));
  for (const auto& entry : fs::directory_iterator(At("bin"))) {
    if (Installation::TextOf(entry.path()).starts_with("#!")) continue;
    const auto libraries = RunShell("ldd '" + entry.path().string() + "' | grep -c 'not found'");
    EXPECT_EQ(libraries.text, "0\n") << entry.path();
    const auto sections =
        RunShell("objdump -h '" + entry.path().string() + "' | grep -cE '[.](symtab|debug_info)'");
    EXPECT_THAT(sections.text, HasSubstr("0\n")) << entry.path() << " is not stripped";
  }
}

TEST_F(InstallTest, UninstallLeavesNothing) {
  const auto answer = installed_.Uninstall();
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_FALSE(fs::exists(installed_.prefix()))
      << RunShell("find '" + installed_.prefix().string() + "'").text;
}

TEST_F(InstallTest, UninstallLeavesWhatIsSomebodyElses) {
  std::ofstream(At("etc/priamos/robot/robot.toml"), std::ios::app) << "# measured\n";
  std::ofstream(At("etc/priamos/priamos.env")) << "PRIAMOS_ROBOT=ada\n";
  std::ofstream(At("bin/another")) << "\n";
  const auto answer = installed_.Uninstall();
  EXPECT_THAT(answer.text, HasSubstr("kept, it was changed: " + At("etc/priamos/robot/robot.toml").string()));
  EXPECT_THAT(Files(), testing::UnorderedElementsAre("bin/another", "etc/priamos/priamos.env",
                                                     "etc/priamos/robot/robot.toml"));
}

TEST_F(InstallTest, AnUninstallWithoutRightsFailsAndCanBeDoneAgain) {
  const auto before = Files();
  const auto refused = installed_.UninstallWithoutRights();
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.text, HasSubstr(fmt::format("0 files removed, {} could not be", before.size())));
  EXPECT_EQ(Files(), before);
  EXPECT_EQ(installed_.Uninstall().exit_code, 0);
  EXPECT_FALSE(fs::exists(installed_.prefix()));
}

/// What is a pattern to a shell or to CMake is a name here.
TEST(InstallBelowABracket, UninstallTakesWhatTheInstallationMadeAndNothingElse) {
  const Installation installed("a[1]/below/prefix");
  const fs::path above = installed.folder() / "a[1]";
  fs::create_directories(above);
  std::ofstream(above / "mine") << "mine\n";
  ASSERT_EQ(installed.Install().exit_code, 0);
  std::ofstream(installed.prefix() / "share/mine") << "mine\n";
  EXPECT_EQ(installed.Uninstall().exit_code, 0);
  EXPECT_EQ(Installation::TextOf(above / "mine"), "mine\n");
  EXPECT_EQ(Installation::TextOf(installed.prefix() / "share/mine"), "mine\n");
  EXPECT_FALSE(fs::exists(installed.prefix() / "share/priamos"));
}

/// Also the folders around the prefix.
TEST(InstallBelowABracket, UninstallTakesTheFoldersAroundThePrefixThatWereMade) {
  const Installation installed("a[1/below/prefix");
  fs::create_directories(installed.folder() / "a[1");
  ASSERT_EQ(installed.Install().exit_code, 0);
  EXPECT_EQ(installed.Uninstall().exit_code, 0);
  EXPECT_TRUE(fs::exists(installed.folder() / "a[1"));
  EXPECT_FALSE(fs::exists(installed.folder() / "a[1/below"));
}

TEST(InstallBelowASemicolon, IsRefusedBeforeAnythingIsWritten) {
  const Installation installed("a;b");
  const auto answer = installed.Install();
  EXPECT_NE(answer.exit_code, 0);
  EXPECT_THAT(answer.text, HasSubstr("the prefix has a \";\""));
  EXPECT_FALSE(fs::exists(installed.prefix()));
  EXPECT_FALSE(fs::exists(installed.folder() / "a"));
}

/// Folders that were there before an installation are not its own, even when they are empty.
TEST(InstallIntoAFolderInUse, TheEmptyFoldersOfOthersStay) {
  const Installation installed;
  fs::create_directories(installed.prefix() / "share/man/man1");
  ASSERT_EQ(installed.Install().exit_code, 0);
  EXPECT_EQ(installed.Uninstall().exit_code, 0);
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(installed.prefix()))
    left.push_back(fs::relative(entry.path(), installed.prefix()).string());
  EXPECT_THAT(left, testing::UnorderedElementsAre("share", "share/man", "share/man/man1"));
}

/// DESTDIR is remembered: `uninstall` needs no word about it.
TEST(InstallIntoUsr, UninstallFindsWhereItWasPut) {
  const Installation installed;
  ASSERT_EQ(installed.InstallForAPackage().exit_code, 0);
  const auto answer = installed.Uninstall();
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_FALSE(fs::exists(installed.package()))
      << RunShell("find '" + installed.package().string() + "'").text;
}

/// For a Debian package, configuration is in /etc.
TEST(InstallIntoUsr, ConfigurationGoesToEtc) {
  const Installation installed;
  const auto answer = installed.InstallForAPackage();
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(fs::exists(installed.package() / "etc/priamos/robot/robot.toml"));
  EXPECT_TRUE(fs::exists(installed.package() / "usr/share/man/man1/priamos.1"));
  EXPECT_THAT(Installation::TextOf(installed.package() / "usr/lib/systemd/system/priamos@.service"),
              HasSubstr("ExecStart=\"/usr/bin/priamos-%i\" --config \"/etc/priamos/robot/%i.toml\""));
}

}  // namespace
}  // namespace priamos
