#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// scripts/setup with an apt-get that only says what it was asked for.
class SetupTest : public ::testing::Test {
 protected:
  SetupTest() {
    Program("apt-get", "echo \"$@\" >> " + (folder_ / "asked").string());
    Program("sudo", "exec \"$@\"");
  }
  void Program(const std::string& name, const std::string& body) {
    const std::string file = folder_ / name;
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    chmod(file.c_str(), 0755);
  }
  /// Its exit code; what it asked of apt-get is in asked_.
  int Run(const std::string& packages) {
    std::ofstream(folder_ / "list.txt") << packages;
    const std::string command = "PATH=" + folder_.path().string() +
                                ":$PATH '" PRIAMOS_SOURCE_DIR "/scripts/setup' " +
                                (folder_ / "list.txt").string() + " > /dev/null 2>&1";
    const int status = std::system(command.c_str());
    std::ostringstream text;
    text << std::ifstream(folder_ / "asked").rdbuf();
    asked_ = text.str();
    return WEXITSTATUS(status);
  }
  TemporaryFolder folder_;
  std::string asked_;
};

TEST_F(SetupTest, APackageThatTheMachineHasNeverHeardOfIsInstalled) {
  EXPECT_EQ(Run("bash  # is there\nno-such-package-of-priamos\n"), 0);
  EXPECT_THAT(asked_, HasSubstr("no-such-package-of-priamos"));
  EXPECT_THAT(asked_, Not(HasSubstr("bash")));
}

TEST_F(SetupTest, NothingIsAskedWhenNothingIsMissing) {
  EXPECT_EQ(Run("# nothing else\nbash\n"), 0);
  EXPECT_EQ(asked_, "");
}

TEST_F(SetupTest, AFailedInstallationEndsTheScript) {
  Program("apt-get", "exit 100");
  EXPECT_EQ(Run("no-such-package-of-priamos\n"), 2);
}

}  // namespace
}  // namespace priamos
