#include "cli/report/report_files.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/archive.hpp"
#include "report_synthetic_run.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using ::testing::HasSubstr;

const std::string kMap = PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml";

class ReportFiles : public ::testing::Test {
 protected:
  std::string Read(const char* name) {
    std::ifstream in(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  TemporaryFolder folder_;
};

TEST_F(ReportFiles, WritesSummaryPicturesAndPage) {
  const RunRecord record = SyntheticRun{}.Record();
  WriteReport(record, Summarise(record, TestInfo()), TestInfo(), kMap, folder_.path());
  std::ifstream json(folder_ / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(json)["passed"], true);
  EXPECT_EQ(Read("run.png").substr(1, 3), "PNG");
  EXPECT_THAT(Read("run.svg"), HasSubstr("door, seed 7"));
  EXPECT_GT(Read("report.html").size(), Read("run.svg").size());
}

TEST_F(ReportFiles, SameRecordGivesTheSameBytes) {
  const RunRecord record = SyntheticRun{}.Record();
  WriteReport(record, Summarise(record, TestInfo()), TestInfo(), kMap, folder_.path());
  const std::string page = Read("report.html");
  WriteReport(record, Summarise(record, TestInfo()), TestInfo(), kMap, folder_.path());
  EXPECT_EQ(Read("report.html"), page);
}

TEST_F(ReportFiles, FolderThatCannotBeWrittenIsNamed) {
  try {
    WriteReport(RunRecord{}, Summary{}, TestInfo(), kMap, folder_ / "missing");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing/summary.json: cannot be written"));
  }
}

TEST(LoadDoor, FindsTheDoorOfTheShippedMap) {
  EXPECT_DOUBLE_EQ(LoadDoor(kMap, 1, true)->opening_width_m, 0.90);
}

TEST(LoadDoor, AFloorMayHaveNone) {
  EXPECT_FALSE(LoadDoor(kMap, 9, false));
}

TEST(LoadDoor, UnknownDoorIsASentence) {
  try {
    LoadDoor(kMap, 9, true);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("expected a door with id 9, got none"));
  }
}

}  // namespace
}  // namespace priamos::cli
