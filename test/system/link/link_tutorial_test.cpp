#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test/system/link/link_script.hpp"

// The tutorial of modules/radio/README.md, as a person types it: read from there, run in a network of its
// own.

namespace priamos {
namespace {

using testing::HasSubstr;

TEST(LinkTutorial, BridgesTheExampleTypeOfLcmInTenLines) {
  const std::string script = ScriptOfReadme("modules/radio/README.md", "## Your own types, in ten lines");
  EXPECT_LE(std::count(script.begin(), script.end(), '\n'), 10);
  const std::string text = RunInPrivateNetwork(script, 30);
  EXPECT_THAT(text, HasSubstr("EXAMPLE"));
  EXPECT_THAT(text, HasSubstr("\"name\":\"hello\"")) << text;
  EXPECT_THAT(text, HasSubstr("\"ranges\":[150,320]"));
  EXPECT_THAT(text, HasSubstr("offboard end: up"));
}

}  // namespace
}  // namespace priamos
