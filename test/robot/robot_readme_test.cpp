#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <string>

#include "robot/robot_config.hpp"
#include "test/robot/failsafe_table.hpp"

namespace priamos::robot {
namespace {

std::string Readme() {
  std::ostringstream text;
  text << std::ifstream(PRIAMOS_SOURCE_DIR "/modules/robot/README.md").rdbuf();
  return text.str();
}

TEST(RobotReadme, ShowsTheFailsafeTableOfTheCode) {
  const std::string expected = "<!-- failsafe table, printed from core/safety/failsafe.cpp -->\n" +
                               FailsafeTable({}) + "<!-- end of failsafe table -->\n";
  EXPECT_NE(Readme().find(expected), std::string::npos) << "put this into the README:\n" << expected;
}

TEST(RobotReadme, SaysHowLongEchoesAndPathsCount) {
  EXPECT_THAT(Readme(), testing::HasSubstr(fmt::format("an echo counts for {} s", EchoMemoryConfig().keep_s)))
      << "modules/robot/README.md, row SONAR_RANGES: write the value of EchoMemoryConfig there";
  EXPECT_THAT(Readme(), testing::HasSubstr(fmt::format("older than {} s: refused; one that was taken",
                                                       RobotConfig().path_max_age_s)))
      << "modules/robot/README.md, row PATH: write the value of RobotConfig there";
}

}  // namespace
}  // namespace priamos::robot
