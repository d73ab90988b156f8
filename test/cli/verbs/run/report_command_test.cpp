#include <gmock/gmock.h>

#include <filesystem>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::EndsWith;

TEST(ReportCommand, OneLogGivenTwiceIsRefusedByName) {
  const TemporaryFolder folder;
  const std::string log = PRIAMOS_SOURCE_DIR "/logs/recorded/door-onboard.lcmlog";
  std::filesystem::create_symlink(log, folder / "again.lcmlog");
  const std::string again = folder / "again.lcmlog", page = folder / "page.html";
  const auto answer = Priamos({"report", log, again, "--out", page});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, EndsWith(log + " and " + again +
                                   ": expected the logs of two buses, got the same file twice\n"));
  EXPECT_FALSE(std::filesystem::exists(page));
}

TEST(ReportCommand, OneFolderOfARunIsNotComparedWithItself) {
  const TemporaryFolder folder;
  const auto answer = Priamos({"report", folder.path(), folder.path()});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, EndsWith(": expected two runs, got the same folder twice\n"));
}

TEST(ReportCommand, ATimeLapseIsAPictureForEachStep) {
  const TemporaryFolder folder;
  const std::string log = PRIAMOS_SOURCE_DIR "/logs/recorded/door-onboard.lcmlog";
  const std::string pictures = folder / "pictures", page = folder / "page.html";
  const auto answer = Priamos({"report", log, "--out", page, "--time-lapse", pictures, "--every", "10"});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, testing::HasSubstr("3 pictures in "));
  for (const char* name : {"0010.png", "0020.png", "0030.png"})
    EXPECT_GT(std::filesystem::file_size(std::filesystem::path(pictures) / name), 5000u) << name;
  const auto again = Priamos({"report", log, "--out", folder / "other.html", "--time-lapse", pictures});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, testing::HasSubstr("--time-lapse: expected a new folder"));
}

}  // namespace
}  // namespace priamos::cli
