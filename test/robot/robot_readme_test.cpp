#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "test/robot/failsafe_table.hpp"

namespace priamos::robot {
namespace {

TEST(RobotReadme, ShowsTheFailsafeTableOfTheCode) {
  std::ifstream file(PRIAMOS_SOURCE_DIR "/modules/robot/README.md");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string expected = "<!-- failsafe table, printed from core/safety/failsafe.cpp -->\n" +
                               FailsafeTable({}) + "<!-- end of failsafe table -->\n";
  EXPECT_NE(text.str().find(expected), std::string::npos) << "put this into the README:\n" << expected;
}

}  // namespace
}  // namespace priamos::robot
