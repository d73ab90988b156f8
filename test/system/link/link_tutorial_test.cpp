#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// The tutorial of modules/radio/README.md, as a person types it: read from there, run in a network of its
// own.

namespace priamos {
namespace {

using testing::HasSubstr;

std::string Tutorial() {
  std::ifstream in(std::string(PRIAMOS_SOURCE_DIR) + "/modules/radio/README.md");
  std::string line, script;
  while (std::getline(in, line) && line != "```sh") {
  }
  while (std::getline(in, line) && line != "```") script += line + "\n";
  return script;
}

std::string RunScript(const std::string& script) {
  const TemporaryFolder folder;
  const std::string file = folder / "tutorial.sh";
  std::ofstream(file) << "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo\n"
                      << "export PATH=" << PRIAMOS_BINARY_DIR << "/bin:$PATH; cd " << PRIAMOS_SOURCE_DIR
                      << "\ntrap 'kill $(jobs -p)' EXIT\n"
                      // Names in /tmp are shared by everybody on the machine.
                      << std::regex_replace(script, std::regex("/tmp/"), folder.path().string() + "/");
  return RunShell("timeout 30 unshare -rn bash " + file).text;
}

TEST(LinkTutorial, BridgesTheExampleTypeOfLcmInTenLines) {
  const std::string script = Tutorial();
  EXPECT_LE(std::count(script.begin(), script.end(), '\n'), 10);
  const std::string text = RunScript(script);
  EXPECT_THAT(text, HasSubstr("EXAMPLE"));
  EXPECT_THAT(text, HasSubstr("\"name\":\"hello\"")) << text;
  EXPECT_THAT(text, HasSubstr("\"ranges\":[150,320]"));
  EXPECT_THAT(text, HasSubstr("offboard end: up"));
}

}  // namespace
}  // namespace priamos
