#include "bus/log/log_export.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bus/log/log_writer.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

std::string ReadText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ExportTest : public testing::Test {
 protected:
  ExportTest() {
    pose_t pose{};
    pose.utime = 42;
    pose.x_m = 1.5;
    AppendEvent(text_, 0, 1'000'000, "POSE", Encode(pose));
    health_t health{};
    health.process = "robot";
    health.text = "a \"quoted\", text";
    AppendEvent(text_, 1, 2'000'000, "HEALTH", Encode(health));
    AppendEvent(text_, 2, 3'000'000, "UNKNOWN", std::vector<std::byte>(30));
    pose.x_m = 2.5;
    AppendEvent(text_, 3, 4'000'000, "POSE", Encode(pose));
  }
  LogReader Log() const { return LogReader(std::as_bytes(std::span(text_))); }
  std::string text_;
  Schema schema_ = OwnTypes();
  TemporaryFolder folder_;
};

TEST_F(ExportTest, JsonLinesHoldEveryMessage) {
  std::ostringstream out;
  auto log = Log();
  const auto count = ExportJsonLines(log, schema_, {}, out);
  EXPECT_EQ(count.written, 3u);
  EXPECT_EQ(count.undecodable, 1u);
  std::istringstream lines(out.str());
  std::string line;
  std::getline(lines, line);
  const auto json = Json::parse(line);
  EXPECT_EQ(json["channel"], "POSE");
  EXPECT_EQ(json["type"], "priamos.pose_t");
  EXPECT_EQ(json["utime"], 1'000'000);
  EXPECT_EQ(json["message"]["x_m"], 1.5);
}

TEST_F(ExportTest, CsvHasATablePerChannel) {
  auto log = Log();
  ExportCsv(log, schema_, {}, folder_.path() / "csv");
  const std::string pose = ReadText(folder_.path() / "csv/POSE.csv");
  EXPECT_EQ(pose.substr(0, pose.find(',', 22)), "log_utime,log_number,utime");
  EXPECT_EQ(std::count(pose.begin(), pose.end(), '\n'), 3);
  EXPECT_NE(pose.find("\r\n4000000,3,42,"), std::string::npos) << pose;
  const std::string health = ReadText(folder_.path() / "csv/HEALTH.csv");
  EXPECT_NE(health.find("\"a \"\"quoted\"\", text\""), std::string::npos) << health;
}

TEST_F(ExportTest, SelectionIsKept) {
  std::ostringstream out;
  auto log = Log();
  LogSelection selection;
  selection.only = {"HEALTH"};
  selection.rename = {{"HEALTH", "H"}};
  EXPECT_EQ(ExportJsonLines(log, schema_, selection, out).written, 1u);
  EXPECT_EQ(Json::parse(out.str())["channel"], "H");
}

TEST_F(ExportTest, CopyIsALog) {
  const std::string copy = folder_ / "copy.lcmlog";
  {
    auto log = Log();
    LogWriter writer(copy);
    LogSelection selection;
    selection.only = {"POSE"};
    EXPECT_EQ(CopyEvents(log, selection, writer), 2u);
  }
  LogReader dut(copy);
  EXPECT_EQ(dut.Next()->utime, 1'000'000);
  EXPECT_EQ(dut.Next()->number, 1);
  EXPECT_FALSE(dut.Next());
}

}  // namespace
}  // namespace priamos::bus
