#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

// `log export` and `log merge`: what becomes of a log.

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

pose_t PoseAt(double x_m) {
  pose_t pose{};
  pose.x_m = x_m;
  return pose;
}

class LogExport : public testing::Test {
 protected:
  LogExport() {
    MessageLog(log_).Add(0, "POSE", PoseAt(1)).Add(1, "POSE", PoseAt(2)).Add(1, "HEALTH", Health());
  }
  static health_t Health() {
    health_t health{};
    health.process = "head";
    return health;
  }
  TemporaryFolder folder_;
  std::string log_ = folder_ / "run.lcmlog";
};

TEST_F(LogExport, LinesOfJsonHoldEveryMessageInOrder) {
  const auto answer = Priamos({"log", "export", log_, "jsonl"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.err, "3 messages; 0 undecodable; 0 damaged places with 0 bytes left out\n");
  const auto lines = LinesOf(answer.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(json::parse(lines[0]).at("message").at("x_m"), 1);
  EXPECT_EQ(json::parse(lines[1]).at("utime"), MessageLog::UtimeAt(1));
  EXPECT_EQ(json::parse(lines[2]).at("message").at("process"), "head");
}

TEST_F(LogExport, WithMessagesOnStandardOutputTheCountGoesToStandardError) {
  const auto taken = Priamos({"log", "export", log_, "jsonl", "--json"});
  EXPECT_EQ(json::parse(taken.err).at("messages"), 3);
  const auto free = Priamos({"log", "export", log_, "jsonl", "--json", "--out", folder_ / "a.jsonl"});
  EXPECT_EQ(json::parse(free.out).at("messages"), 3);
  EXPECT_EQ(free.err, "");
}

TEST_F(LogExport, CsvIsATablePerChannelInANewFolder) {
  const std::string tables = folder_ / "tables";
  EXPECT_EQ(Priamos({"log", "export", log_, "csv", "--out", tables, "--channels", "POSE"}).exit_code, 0);
  const auto lines = LinesOf(FileContent(tables + "/POSE.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], StartsWith("log_utime,log_number,utime,x_m"));
  EXPECT_THAT(lines[2], StartsWith("1001000000,1,1001000000,2"));
  EXPECT_FALSE(std::filesystem::exists(tables + "/HEALTH.csv")) << "not chosen";
}

TEST_F(LogExport, AFolderWithFilesIsUsedOnlyByForce) {
  const std::string tables = folder_ / "tables";
  std::filesystem::create_directory(tables);
  EXPECT_EQ(Priamos({"log", "export", log_, "csv", "--out", tables}).exit_code, 0) << "an empty one is";
  const auto again = Priamos({"log", "export", log_, "csv", "--out", tables});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("expected a new folder, got one with files in it; --force uses it"));
  EXPECT_EQ(Priamos({"log", "export", log_, "csv", "--out", tables, "--force"}).exit_code, 0);
}

TEST_F(LogExport, McapBeginsAndEndsWithItsMagic) {
  const std::string out = folder_ / "run.mcap", magic = "\x89MCAP0\r\n";
  EXPECT_EQ(Priamos({"log", "export", log_, "mcap", "--out", out}).exit_code, 0);
  const std::string bytes = FileContent(out);
  EXPECT_TRUE(bytes.starts_with(magic));
  EXPECT_TRUE(bytes.ends_with(magic));
}

TEST_F(LogExport, AnMcapHasTheRobotAsThePanelsDrawItToo) {
  const std::string out = folder_ / "run.mcap", map = folder_ / "map.toml";
  std::ofstream(map) << "[[walls]]\nname = \"north\"\nfrom_m = [0.0, 0.0]\nto_m = [2.0, 0.0]\n";
  EXPECT_EQ(Priamos({"log", "export", log_, "mcap", "--out", out, "--map", map}).exit_code, 0);
  const std::string bytes = FileContent(out);
  for (const char* drawn :
       {"/tf", "foxglove.FrameTransform", "/scene/robot", "/scene/plan", "foxglove.SceneUpdate",
        R"("child_frame_id":"base","translation":{"x":2.0)", R"("id":"plan")"})
    EXPECT_THAT(bytes, HasSubstr(drawn));
  EXPECT_EQ(Priamos({"log", "export", log_, "mcap", "--out", out, "--plain", "--force"}).exit_code, 0);
  EXPECT_THAT(FileContent(out), testing::Not(HasSubstr("foxglove")));
}

TEST_F(LogExport, ALogOfUnknownTypesNamesTheOptionThatBringsThem) {
  const std::string foreign = folder_ / "foreign.lcmlog";
  MessageLog(foreign).AddBytes(0, "FOREIGN", std::vector<std::byte>(12, std::byte{7}));
  const auto answer = Priamos({"log", "export", foreign, "jsonl"});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.err, HasSubstr("0 messages; 1 undecodable; 0 damaged places"));
  EXPECT_THAT(answer.err, HasSubstr("no message could be decoded; name its .lcm folder with --types"));
}

class LogMerge : public testing::Test {
 protected:
  LogMerge() {
    MessageLog(onboard_).Add(10, "POSE", PoseAt(1));
    MessageLog(offboard_).Add(2, "POSE", PoseAt(5));
  }
  TemporaryFolder folder_;
  std::string onboard_ = folder_ / "onboard.lcmlog", offboard_ = folder_ / "offboard.lcmlog";
  std::string out_ = folder_ / "run.lcmlog";
};

TEST_F(LogMerge, TheGivenOffsetIsAddedToTheOffboardTimes) {
  const auto answer = Priamos({"log", "merge", onboard_, offboard_, out_, "--offset", "3", "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto dut = json::parse(answer.out);
  EXPECT_EQ(dut.at("events"), 2);
  EXPECT_DOUBLE_EQ(dut.at("offset_s"), 3);
  EXPECT_DOUBLE_EQ(dut.at("drift_ppm"), 0);
  const auto events = EventsOf(out_);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].channel, "OFFBOARD_POSE");
  EXPECT_EQ(events[0].utime, MessageLog::UtimeAt(2 + 3));
  EXPECT_EQ(events[1].channel, "POSE") << "in order of time";
}

TEST_F(LogMerge, AnOffsetBeyondWhatReadersTakeIsRefusedWithTheRange) {
  const auto answer = Priamos({"log", "merge", onboard_, offboard_, out_, "--offset", "1e10"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--offset: expected -9007200256 to 9007198252 s"));
  EXPECT_THAT(answer.err, HasSubstr("stay before the year 2255, got 10000000000"));
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(Priamos({"log", "merge", onboard_, offboard_, out_, "--offset", "9007198252"}).exit_code, 0);
  EXPECT_EQ(EventsOf(out_).size(), 2u);
}

TEST_F(LogMerge, ThePrefixIsAsked) {
  EXPECT_EQ(
      Priamos({"log", "merge", onboard_, offboard_, out_, "--offset", "0", "--prefix", "DESK/"}).exit_code,
      0);
  EXPECT_EQ(EventsOf(out_)[0].channel, "DESK/POSE");
}

TEST_F(LogMerge, LogsOfDifferentRunsAreRefusedWithTheWayOut) {
  const auto answer = Priamos({"log", "merge", onboard_, offboard_, out_});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("expected messages that crossed the radio, got none that are in both"));
  EXPECT_THAT(answer.err, HasSubstr("--offset SECONDS joins them anyway"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(LogMerge, DamageOfEitherLogIsToldWithItsPlace) {
  const auto whole = Priamos({"log", "merge", onboard_, offboard_, out_, "--offset", "0", "--json"});
  EXPECT_EQ(whole.err, "");
  EXPECT_EQ(json::parse(whole.out).at("damaged_places"), 0);
  std::ofstream(offboard_, std::ios::app) << "torn";
  const auto answer =
      Priamos({"log", "merge", onboard_, offboard_, out_, "--offset", "0", "--json", "--force"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.err, StartsWith(offboard_ + ": 1 damaged place with 4 bytes left out: first "));
  EXPECT_EQ(LinesOf(answer.err).size(), 1u) << "the onboard log is whole";
  EXPECT_EQ(json::parse(answer.out).at("damaged_places"), 1);
  EXPECT_EQ(json::parse(answer.out).at("skipped_bytes"), 4);
  EXPECT_EQ(json::parse(answer.out).at("events"), 2);
}

TEST_F(LogMerge, OneLogIsNotMergedWithItself) {
  const std::string link = folder_ / "link.lcmlog";
  std::filesystem::create_symlink(onboard_, link);
  for (const std::string& second : {onboard_, link}) {
    const auto answer = Priamos({"log", "merge", onboard_, second, out_, "--offset", "0"});
    EXPECT_EQ(answer.exit_code, 2) << second;
    EXPECT_THAT(answer.err, HasSubstr("expected the logs of two buses, got the same file twice")) << second;
    EXPECT_FALSE(std::filesystem::exists(out_)) << second;
  }
}

TEST_F(LogMerge, TheSecondLogIsNotOverwrittenEither) {
  const std::string before = FileContent(offboard_);
  EXPECT_EQ(Priamos({"log", "merge", onboard_, offboard_, offboard_, "--offset", "0", "--force"}).exit_code,
            2);
  EXPECT_EQ(FileContent(offboard_), before);
}

/// Both logs of the recorded run have the clock of one lockstep.
TEST(LogMergeOfTheRecordedRun, FindsClocksThatAgree) {
  TemporaryFolder folder;
  const std::string recorded = std::string(PRIAMOS_SOURCE_DIR) + "/logs/recorded/door-";
  const auto answer = Priamos({"log", "merge", recorded + "onboard.lcmlog", recorded + "offboard.lcmlog",
                               folder / "run.lcmlog", "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto dut = json::parse(answer.out);
  EXPECT_TRUE(dut.at("both_directions"));
  EXPECT_NEAR(dut.at("offset_s"), 0, 0.2) << "less than a message needs over the radio";
  EXPECT_GT(dut.at("messages_in_both"), 50);
}

}  // namespace
}  // namespace priamos::cli
