#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {

/// Tests whose bash scripts bring robots up in a network of their own. `$LOGS` is where those write, `pid_of
/// PROCESS` prints the pid of a process that `priamos up` started; a suite adds helpers of its own.
class RobotShell : public testing::Test {
 protected:
  explicit RobotShell(std::string helpers) : helpers_(std::move(helpers)) {}

  ShellAnswer RunScript(const std::string& script, int seconds = 60) const {
    return RunInPrivateNetwork("LOGS=" + (folder_ / "logs").string() + "\n" + kPidOf + helpers_ + script,
                               folder_ / "script.sh", seconds);
  }

 private:
  static constexpr const char* kPidOf =
      R"sh(pid_of() { grep -A3 "\"name\": \"$1\"" $LOGS/up.json | grep -o '"pid": [0-9]*' | cut -d' ' -f2; }
)sh";
  const TemporaryFolder folder_;
  const std::string helpers_;
};

}  // namespace priamos
