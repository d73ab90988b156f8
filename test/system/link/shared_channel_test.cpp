#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// Two robots and their station on one emulated channel, as modules/radio/README.md has it: read from there,
// run in a network of its own.

namespace priamos {
namespace {

using testing::HasSubstr;

std::string Example() {
  std::ifstream in(std::string(PRIAMOS_SOURCE_DIR) + "/modules/radio/README.md");
  std::string line, script;
  while (std::getline(in, line) && line != "## Several robots on one channel") {
  }
  while (std::getline(in, line) && line != "```sh") {
  }
  while (std::getline(in, line) && line != "```") script += line + "\n";
  return script;
}

std::string RunScript(const std::string& script) {
  const TemporaryFolder folder;
  const std::string file = folder / "robots.sh";
  std::ofstream(file) << "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo\n"
                      << "export PATH=" << PRIAMOS_BINARY_DIR << "/bin:$PATH; cd " << PRIAMOS_SOURCE_DIR
                      << "\ntrap 'kill $(jobs -p)' EXIT\n"
                      // Names in /tmp are shared by everybody on the machine.
                      << std::regex_replace(script, std::regex("/tmp/"), folder.path().string() + "/");
  return RunShell("timeout 60 unshare -rn bash " + file).text;
}

TEST(SharedChannel, AStopReachesTheRobotItIsFor) {
  const std::string text = RunScript(Example());
  EXPECT_THAT(text, HasSubstr("2 robots on one channel")) << text;
  EXPECT_THAT(text, HasSubstr("\"driver\":2")) << text;
  EXPECT_THAT(text, HasSubstr("offboard end: up")) << text;
}

}  // namespace
}  // namespace priamos
