// What `cmake --install` puts on a robot: configuration that survives the next installation, and units that
// systemd takes.

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class InstallTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(Install(), 0); }
  int Install() const {
    return Shell("DESTDIR=" + folder_.path().string() + " cmake -DCMAKE_INSTALL_PREFIX=/usr -P " +
                 PRIAMOS_BINARY_DIR "/config/robot/cmake_install.cmake > /dev/null");
  }
  static int Shell(const std::string& command) { return std::system(command.c_str()); }
  static std::string TextOf(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  /// Wherever the build says that it is.
  fs::path Find(const std::string& name) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.path().filename() == name) return entry.path();
    ADD_FAILURE() << name << " was not installed";
    return {};
  }
  const TemporaryFolder folder_;
};

TEST_F(InstallTest, UnitsAreHardenedAndSupervised) {
  const std::string unit = TextOf(Find("priamos@.service"));
  EXPECT_THAT(unit, Not(HasSubstr("@CMAKE")));
  EXPECT_THAT(unit, ContainsRegex("ExecStart=/.*/priamos-%i --config /.*/priamos/%i.toml --bus"));
  for (const char* line : {"Type=notify", "WatchdogSec=", "Restart=always", "NoNewPrivileges=yes",
                           "CapabilityBoundingSet=\n", "ProtectSystem=strict", "SystemCallFilter="})
    EXPECT_THAT(unit, HasSubstr(line));
  EXPECT_THAT(TextOf(Find("priamos.target")), HasSubstr("[Install]"));
  EXPECT_THAT(TextOf(Find("priamos.conf")), HasSubstr("u priamos"));
}

TEST_F(InstallTest, SystemdTakesTheUnits) {
  if (Shell("systemd-analyze --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no systemd-analyze here";
  std::string unit = TextOf(Find("priamos@.service"));
  const std::string key = "ExecStart=";
  const auto begin = unit.find(key) + key.size(), end = unit.find(' ', begin);
  unit.replace(begin, end - begin, PRIAMOS_BINARY_DIR "/bin/priamos-%i");
  const fs::path file = folder_ / "priamos@robot.service", answer = folder_ / "answer";
  std::ofstream(file) << unit;
  EXPECT_EQ(Shell("systemd-analyze verify --man=no " + file.string() + " > " + answer.string() + " 2>&1"), 0);
  EXPECT_EQ(TextOf(answer), "");
  const std::string security = "systemd-analyze security --offline=true --threshold=25 ";
  EXPECT_EQ(Shell(security + file.string() + " > " + answer.string() + " 2>&1"), 0) << TextOf(answer);
}

TEST_F(InstallTest, AnInstallationKeepsWhatWasChangedOnTheRobot) {
  const fs::path file = Find("robot.toml"), other = Find("link.toml");
  std::ofstream(file) << "# mine\n";
  fs::remove(other);
  ASSERT_EQ(Install(), 0);
  EXPECT_EQ(TextOf(file), "# mine\n");
  EXPECT_TRUE(fs::exists(other)) << "what is missing comes back";
}

}  // namespace
}  // namespace priamos
