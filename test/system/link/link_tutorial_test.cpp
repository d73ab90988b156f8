#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test/system/link/link_script.hpp"

// The examples of modules/radio/README.md, as a person types them: read from there, run in a network of their
// own.

namespace priamos {
namespace {

using testing::HasSubstr;

constexpr const char* kReadme = "modules/radio/README.md";

/// What an example says that sends a stop.
std::string RunStopExample(const std::string& heading) {
  const std::string text = RunInPrivateNetwork(ScriptOfReadme(kReadme, heading), 60);
  EXPECT_THAT(text, HasSubstr("\"driver\":2")) << text;
  EXPECT_THAT(text, HasSubstr("offboard end: up")) << text;
  return text;
}

TEST(LinkTutorial, BridgesTheExampleTypeOfLcmInTenLines) {
  const std::string script = ScriptOfReadme(kReadme, "## Your own types, in ten lines");
  EXPECT_LE(std::count(script.begin(), script.end(), '\n'), 10);
  const std::string text = RunInPrivateNetwork(script, 30);
  EXPECT_THAT(text, HasSubstr("EXAMPLE"));
  EXPECT_THAT(text, HasSubstr("\"name\":\"hello\"")) << text;
  EXPECT_THAT(text, HasSubstr("\"ranges\":[150,320]"));
  EXPECT_THAT(text, HasSubstr("offboard end: up"));
}

TEST(SharedChannel, AStopReachesTheRobotItIsFor) {
  EXPECT_THAT(RunStopExample("## Several robots on one channel"), HasSubstr("2 robots on one channel"));
}

TEST(PacketRadios, AStopPassesThroughTwoThatSpeakKiss) {
  RunStopExample("## Packet radios");
}

}  // namespace
}  // namespace priamos
