#include "common/text/nearest_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

class NearestFileTest : public testing::Test {
 protected:
  NearestFileTest() {
    std::filesystem::create_directories(folder_ / "20261122-door");
    for (const char* name : {"day.lcmlog", "20261122-door/onboard.lcmlog", "20261122-door/offboard.lcmlog",
                             "20261122-door/report.html"})
      std::ofstream(folder_ / name) << name;
  }
  std::string At(const std::string& name) const { return fmt::format("\"{}\"", (folder_ / name).string()); }
  TemporaryFolder folder_;
};

TEST_F(NearestFileTest, AMistypedNameOrEnding) {
  EXPECT_EQ(NearestFileText(folder_ / "dya.lcmlog", ".lcmlog"), "; nearest: " + At("day.lcmlog"));
  EXPECT_EQ(NearestFileText(folder_ / "day.lgo", ".lcmlog"), "; nearest: " + At("day.lcmlog"));
  EXPECT_EQ(NearestFileText(folder_ / "elephant", ".lcmlog"), "");
  EXPECT_EQ(NearestFileText("", ".lcmlog"), "");
}

TEST_F(NearestFileTest, ALinkThatLeadsNowhereIsNotNamed) {
  std::filesystem::create_symlink("no-such-log", folder_ / "night.lcmlog");
  EXPECT_EQ(NearestFileText(folder_ / "night.lcmlog", ".lcmlog"), "");
  EXPECT_EQ(NearestFileText(folder_ / "nihgt.lcmlog", ".lcmlog"), "");
}

TEST_F(NearestFileTest, AMistypedFolderIsFoundTogetherWithWhatIsBehindIt) {
  EXPECT_EQ(NearestFileText(folder_ / "20261122-dor/onboard.lcmlog", ".lcmlog"),
            "; nearest: " + At("20261122-door/onboard.lcmlog"));
  EXPECT_EQ(NearestFileText(folder_ / "20261122-dor/x.lcmlog", ".lcmlog"),
            "; nearest: " + At("20261122-door"));
}

TEST_F(NearestFileTest, AFolderInsteadOfALogNamesTheLogsInIt) {
  EXPECT_EQ(NearestFileText(folder_ / "20261122-door", ".lcmlog"),
            "; in that folder: " + At("20261122-door/offboard.lcmlog") + " or " +
                At("20261122-door/onboard.lcmlog"));
}

}  // namespace
}  // namespace priamos
