#include "cli/verbs/wire/channel_table.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace priamos::cli {
namespace {

TEST(ChannelTable, IsTheOneInTheReadmeOfTheTypes) {
  std::ostringstream readme;
  readme << std::ifstream(PRIAMOS_SOURCE_DIR "/lcmtypes/README.md").rdbuf();
  EXPECT_THAT(readme.str(), testing::HasSubstr(ChannelTable())) << "print it anew: priamos type channels";
}

}  // namespace
}  // namespace priamos::cli
