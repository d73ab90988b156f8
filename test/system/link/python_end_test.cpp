#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "test/system/link/link_script.hpp"

// The Python end: its own tests, and the example of its README beside a real priamos-radio.

namespace priamos {
namespace {

using testing::HasSubstr;

TEST(PythonEnd, SendsAStopToARealRobotsEnd) {
  const std::string script = ScriptOfReadme("bus/python/README.md", "## One end of the radio link");
  const std::string text = RunInPrivateNetwork(script, 30);
  EXPECT_THAT(text, HasSubstr("priamos_link: link is up")) << text;
  EXPECT_THAT(text, HasSubstr("\"driver\":2")) << text;
  EXPECT_THAT(text, HasSubstr("\"channel\": \"HEALTH\"")) << text;
}

TEST(PythonEnd, RefusesWhatItCannotUseInOneSentence) {
  const auto answer = [](const std::string& options) {
    return RunShell("cd " + std::string(PRIAMOS_SOURCE_DIR) +
                    "/bus/python && python3 -m priamos_link --port /dev/null " + options);
  };
  for (const std::string options : {"--table /nowhere", "--table README.md", "--table /dev/zero"}) {
    const ShellAnswer refused = answer(options);
    EXPECT_EQ(refused.exit_code, 2) << options;
    EXPECT_THAT(refused.text, HasSubstr(": expected")) << options;
    EXPECT_EQ(std::count(refused.text.begin(), refused.text.end(), '\n'), 1) << refused.text;
  }
}

}  // namespace
}  // namespace priamos
