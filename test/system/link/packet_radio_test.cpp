#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "test/system/link/link_script.hpp"

// Two packet radios, emulated, as modules/radio/README.md has it: read from there, run in a network of its
// own.

namespace priamos {
namespace {

using testing::HasSubstr;

TEST(PacketRadios, AStopPassesThroughTwoThatSpeakKiss) {
  const std::string text =
      RunInPrivateNetwork(ScriptOfReadme("modules/radio/README.md", "## Packet radios"), 60);
  EXPECT_THAT(text, HasSubstr("\"driver\":2")) << text;
  EXPECT_THAT(text, HasSubstr("offboard end: up")) << text;
}

}  // namespace
}  // namespace priamos
