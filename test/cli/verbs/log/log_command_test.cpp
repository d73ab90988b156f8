#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "priamos/type_text_t.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// Five poses at 4 Hz and one message of an unknown type.
class LogCommand : public testing::Test {
 protected:
  LogCommand() {
    MessageLog log(log_);
    for (int i = 0; i < 5; ++i) {
      pose_t pose{};
      pose.x_m = i;
      log.Add(0.25 * i, "POSE", pose);
    }
    log.AddBytes(2.0, "FOREIGN", std::vector<std::byte>(12, std::byte{7}));
  }
  /// The log with its bytes from `begin` on replaced by nonsense.
  std::string Damaged(std::size_t begin, std::size_t size) {
    std::string bytes = FileContent(log_);
    bytes.replace(begin, size, size, '?');
    const std::string file = folder_ / "damaged.lcmlog";
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  static std::vector<std::int64_t> NumbersOf(const std::string& file) {
    std::vector<std::int64_t> numbers;
    for (const bus::LogEvent& event : EventsOf(file)) numbers.push_back(event.number);
    return numbers;
  }
  TemporaryFolder folder_;
  std::string log_ = folder_ / "run.lcmlog";
};

TEST_F(LogCommand, InfoCountsEventsRatesAndUnknownTypes) {
  const auto answer = Priamos({"log", "info", log_, "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto dut = json::parse(answer.out);
  EXPECT_EQ(dut.at("file"), log_);
  EXPECT_EQ(dut.at("events"), 6);
  EXPECT_EQ(dut.at("size_bytes"), FileContent(log_).size());
  EXPECT_EQ(dut.at("first_utime"), MessageLog::UtimeAt(0));
  EXPECT_EQ(dut.at("last_utime"), MessageLog::UtimeAt(2));
  EXPECT_EQ(dut.at("undecodable"), 1);
  const auto& foreign = dut.at("channels").at(0);
  EXPECT_EQ(foreign.at("types"), json::array({"?"}));
  EXPECT_EQ(foreign.at("bytes"), 12);
  const auto& pose = dut.at("channels").at(1);
  EXPECT_EQ(pose.at("channel"), "POSE");
  EXPECT_DOUBLE_EQ(pose.at("rate_hz"), 4) << "five events in four periods of 0.25 s";
}

TEST_F(LogCommand, InfoForAPersonHasADateAndALinePerChannel) {
  const auto lines = LinesOf(Priamos({"log", "info", log_}).out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_THAT(lines[0], HasSubstr("6 events in 2.0 s from 1970-01-01 00:16:40 UTC"));
  EXPECT_THAT(lines[0], HasSubstr("no damage, no event missing"));
  EXPECT_THAT(lines[3], AllOf(StartsWith("POSE "), HasSubstr("priamos.pose_t"), HasSubstr(" 4.00 ")));
}

TEST_F(LogCommand, InfoOfADamagedLogCountsTheLossAndExitsWithOne) {
  const std::size_t event = 28 + 4 + 112;  // header, POSE, its 14 numbers of 8 bytes with the fingerprint
  const auto answer = Priamos({"log", "info", Damaged(event, event), "--json"});
  EXPECT_EQ(answer.exit_code, 1);
  const auto dut = json::parse(answer.out);
  EXPECT_EQ(dut.at("damaged_places"), 1);
  EXPECT_EQ(dut.at("skipped_bytes"), event);
  EXPECT_EQ(dut.at("missing_events"), 1);
  EXPECT_THAT(Priamos({"log", "info", Damaged(event, event)}).out,
              HasSubstr("1 damaged place, 144 bytes skipped, 1 event missing; first bytes that begin no "
                        "event at byte 144"));
}

TEST_F(LogCommand, AnEmptyLogIsOfNoTime) {
  const std::string empty = folder_ / "empty.lcmlog";
  std::ofstream(empty).close();
  EXPECT_EQ(LinesOf(Priamos({"log", "info", empty}).out).at(0),
            empty + ": 0 events, 0 bytes; no damage, no event missing");
}

TEST_F(LogCommand, WhatReadersTakeForDamageIsNamed) {
  const std::string log = folder_ / "name.lcmlog";
  MessageLog(log).AddBytes(0, "P\xc3\xb6SE", std::vector<std::byte>(8)).Add(0, "POSE", pose_t{});
  const auto dut = json::parse(Priamos({"log", "info", log, "--json"}).out);
  EXPECT_EQ(dut.at("first_damage").at("what"), "a channel with a name that is not printable ASCII");
  EXPECT_EQ(dut.at("first_damage").at("offset"), 0);
}

TEST_F(LogCommand, APipeIsNoLogAndIsNotWaitedFor) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const char* verb : {"info", "index"}) {
    const auto answer = Priamos({"log", verb, pipe});
    EXPECT_EQ(answer.exit_code, 2) << verb;
    EXPECT_THAT(answer.err, HasSubstr(pipe + ": expected a log, got a pipe")) << verb;
  }
}

TEST_F(LogCommand, NoVerbWaitsForAPipeThatItIsToWrite) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::vector<std::string>& line : std::vector<std::vector<std::string>>{
           {"log", "filter", log_, pipe, "--force"},
           {"log", "repair", log_, pipe, "--force"},
           {"log", "merge", log_, Damaged(0, 0), pipe, "--offset", "0", "--force"},
           {"log", "index", log_, "--out", pipe, "--force"},
           {"log", "export", log_, "jsonl", "--out", pipe, "--force"},
           {"log", "export", log_, "csv", "--out", pipe, "--force"},
           {"log", "record", pipe, "--seconds", "0.1"},
           {"lockstep", "--json", pipe}}) {
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << testing::PrintToString(line);
    EXPECT_THAT(answer.err, AllOf(HasSubstr(pipe), AnyOf(HasSubstr("got a pipe"), HasSubstr("record"))))
        << testing::PrintToString(line);
  }
}

TEST_F(LogCommand, IndexOfADamagedLogSaysSoAndExitsWithOne) {
  const std::string damaged = Damaged(144, 144);
  const auto answer = Priamos({"log", "index", damaged});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_EQ(LinesOf(answer.out).size(), 6u);
  EXPECT_EQ(answer.err, damaged +
                            ": 1 damaged place with 144 bytes left out: first bytes that begin no event at "
                            "byte 144\n");
  const std::string out = folder_ / "index.csv";
  EXPECT_EQ(Priamos({"log", "index", damaged, "--out", out, "--json"}).exit_code, 1);
  EXPECT_EQ(LinesOf(FileContent(out)).size(), 5u) << "what is whole is there";
}

TEST_F(LogCommand, IndexHasALinePerEventWithItsPlace) {
  const auto answer = Priamos({"log", "index", log_});
  EXPECT_EQ(answer.exit_code, 0);
  const auto lines = LinesOf(answer.out);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[0], "offset,number,utime,channel,bytes,type\r");
  EXPECT_EQ(lines[1], "0,0,1000000000,\"POSE\",112,priamos.pose_t\r");
  EXPECT_EQ(lines[2], "144,1,1000250000,\"POSE\",112,priamos.pose_t\r");
  EXPECT_EQ(lines[6], "720,5,1002000000,\"FOREIGN\",12,?\r");
}

TEST_F(LogCommand, IndexAsJsonSaysTheSame) {
  const auto lines = LinesOf(Priamos({"log", "index", log_, "--json"}).out);
  ASSERT_EQ(lines.size(), 6u);
  const auto second = json::parse(lines[1]);
  EXPECT_EQ(second.at("offset"), 144);
  EXPECT_EQ(second.at("type"), "priamos.pose_t");
  EXPECT_EQ(json::parse(lines[5]).at("channel"), "FOREIGN");
}

TEST_F(LogCommand, IndexDoublesAQuoteInTheNameOfAChannel) {
  const std::string log = folder_ / "quotes.lcmlog";
  MessageLog(log).Add(0, "A\"B", pose_t{});
  EXPECT_THAT(LinesOf(Priamos({"log", "index", log}).out).at(1), HasSubstr(",\"A\"\"B\",")) << "RFC 4180";
}

TEST_F(LogCommand, FilterKeepsTheChosenChannelsAndTimes) {
  const std::string out = folder_ / "some.lcmlog";
  const auto answer = Priamos({"log", "filter", log_, out, "--channels", "PO*", "--from", "0.25", "--to",
                               "0.75", "--rename", "POSE=POSE_OLD", "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(json::parse(answer.out).at("events"), 2);
  const auto events = EventsOf(out);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].channel, "POSE_OLD");
  EXPECT_EQ(events[0].utime, MessageLog::UtimeAt(0.25)) << "the first time belongs to it";
  EXPECT_EQ(events[1].utime, MessageLog::UtimeAt(0.5)) << "the last one does not";
}

TEST_F(LogCommand, FilterWithoutChannelsLeavesThemOut) {
  const std::string out = folder_ / "some.lcmlog";
  EXPECT_EQ(Priamos({"log", "filter", log_, out, "--without", "POSE"}).exit_code, 0);
  ASSERT_EQ(EventsOf(out).size(), 1u);
  EXPECT_EQ(EventsOf(out)[0].channel, "FOREIGN");
}

TEST_F(LogCommand, ARefusedFilterLeavesTheFileThatItWouldHaveReplaced) {
  const std::string out = folder_ / "precious.lcmlog";
  std::ofstream(out) << "precious";
  const auto answer = Priamos({"log", "filter", log_, out, "--force", "--rename", "POSE"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(answer.err, "priamos log filter: --rename: expected A=B, got \"POSE\"\n");
  EXPECT_EQ(FileContent(out), "precious");
}

TEST_F(LogCommand, RepairKeepsEveryWholeEventAndItsNumber) {
  const std::string out = folder_ / "mended.lcmlog";
  const auto answer = Priamos({"log", "repair", Damaged(144, 144), out});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out,
            out +
                ": 5 events with their numbers; 1 damaged place with 144 bytes left out: first bytes "
                "that begin no event at byte 144\n");
  EXPECT_THAT(NumbersOf(out), ElementsAre(0, 2, 3, 4, 5)) << "the lost one leaves a gap";
}

TEST_F(LogCommand, WhatADamagedLogLostStaysVisibleInTheMendedOne) {
  const std::string out = folder_ / "mended.lcmlog";
  EXPECT_EQ(Priamos({"log", "repair", Damaged(144, 144), out}).exit_code, 0);
  const auto mended = Priamos({"log", "info", out, "--json"});
  EXPECT_EQ(mended.exit_code, 1);
  EXPECT_EQ(json::parse(mended.out).at("damaged_places"), 0);
  EXPECT_EQ(json::parse(mended.out).at("missing_events"), 1);
}

TEST_F(LogCommand, RepairOfAWholeLogIsACopyToTheByte) {
  const std::string out = folder_ / "copy.lcmlog";
  EXPECT_EQ(Priamos({"log", "repair", log_, out}).exit_code, 0);
  EXPECT_EQ(FileContent(out), FileContent(log_));
}

TEST_F(LogCommand, RepairOfAWholeLogWithLargeNumbersIsACopyToTheByte) {
  const std::string large = folder_ / "large.lcmlog", out = folder_ / "copy.lcmlog";
  std::string bytes;
  for (const std::int64_t number :
       {std::int64_t{1} << 62, (std::int64_t{1} << 62) + 1, INT64_MAX - 1, INT64_MAX})
    bus::AppendEvent(bytes, number, 1000, "POSE", {});
  std::ofstream(large, std::ios::binary) << bytes;
  EXPECT_EQ(Priamos({"log", "repair", large, out}).exit_code, 0);
  EXPECT_EQ(FileContent(out), bytes);
  EXPECT_EQ(Priamos({"log", "info", large}).exit_code, 0);
}

TEST_F(LogCommand, RepairKeepsTheEventAroundAnotherOne) {
  const std::string torn = folder_ / "torn.lcmlog", out = folder_ / "mended.lcmlog";
  std::string inner, last, first;
  bus::AppendEvent(inner, 7, 7, "INNER", {});
  bus::AppendEvent(first, 0, 1000, "POSE", std::vector<std::byte>(100));
  bus::AppendEvent(last, 1, 1001, "RAW", std::as_bytes(std::span(inner)));
  std::ofstream(torn, std::ios::binary) << first.substr(0, 90) << last;
  EXPECT_EQ(Priamos({"log", "repair", torn, out}).exit_code, 0);
  EXPECT_EQ(FileContent(out), last);
  std::ofstream(torn, std::ios::binary) << first << last.substr(0, last.size() - 1);
  EXPECT_EQ(Priamos({"log", "repair", torn, out, "--force"}).exit_code, 0);
  EXPECT_EQ(FileContent(out), first);
}

TEST_F(LogCommand, RepairReportsNumbersThatDoNotIncreaseAndKeepsThem) {
  const std::string joined = folder_ / "joined.lcmlog", out = folder_ / "mended.lcmlog";
  std::ofstream(joined, std::ios::binary) << FileContent(log_) << FileContent(log_);
  const auto answer = Priamos({"log", "repair", joined, out});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, HasSubstr(out + ": the numbers do not increase at 1 event: damaged numbers, or "
                                          "joined logs\n"));
  EXPECT_THAT(NumbersOf(out), ElementsAre(0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5));
  const auto in_json = json::parse(Priamos({"log", "repair", joined, out, "--force", "--json"}).out);
  EXPECT_EQ(in_json.at("numbers_not_increasing"), 1);
  EXPECT_EQ(in_json.at("events"), 12);
}

TEST_F(LogCommand, FilterNumbersAnewBecauseWhatIsLeftOutIsNoLoss) {
  const std::string out = folder_ / "some.lcmlog";
  EXPECT_EQ(Priamos({"log", "filter", log_, out, "--from", "0.5"}).exit_code, 0);
  EXPECT_THAT(NumbersOf(out), ElementsAre(0, 1, 2, 3));
}

TEST_F(LogCommand, WhatIsThereIsReplacedOnlyByForce) {
  const std::string out = folder_ / "there.lcmlog";
  std::ofstream(out) << "there";
  for (const char* verb : {"filter", "repair"}) {
    const auto answer = Priamos({"log", verb, log_, out});
    EXPECT_EQ(answer.exit_code, 2) << verb;
    EXPECT_THAT(answer.err, HasSubstr("there.lcmlog: expected a new file, got an existing one; --force"));
    EXPECT_EQ(FileContent(out), "there") << verb;
  }
  EXPECT_EQ(Priamos({"log", "repair", log_, out, "--force"}).exit_code, 0);
  EXPECT_EQ(EventsOf(out).size(), 6u);
}

TEST_F(LogCommand, NoVerbWritesIntoTheLogThatItReads) {
  const std::string before = FileContent(log_);
  const std::vector<std::vector<std::string>> lines{
      {"log", "filter", log_, log_, "--force"},
      {"log", "repair", log_, log_, "--force"},
      {"log", "index", log_, "--out", log_, "--force"},
      {"log", "export", log_, "jsonl", "--out", log_, "--force"},
      {"report", log_, "--out", log_, "--force"}};
  for (const auto& line : lines) {
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << line[1];
    EXPECT_THAT(answer.err, HasSubstr("expected another file than the one that is read")) << line[1];
  }
  EXPECT_EQ(FileContent(log_), before);
}

TEST_F(LogCommand, AReportIsNotWrittenIntoTheMapThatItReads) {
  const std::string map = folder_ / "map.toml",
                    before = FileContent(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml");
  std::ofstream(map) << before;
  const auto answer = Priamos({"report", log_, "--map", map, "--out", map, "--force"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("expected another file than the one that is read"));
  EXPECT_EQ(FileContent(map), before);
}

TEST_F(LogCommand, AMissingLogAndAWrongFormatAreNamed) {
  const auto missing = Priamos({"log", "info", folder_ / "none.lcmlog"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, AllOf(HasSubstr("log: expected an existing file"), HasSubstr("none.lcmlog")));
  const auto format = Priamos({"log", "export", log_, "cvs"});
  EXPECT_EQ(format.exit_code, 2);
  EXPECT_THAT(format.err, AllOf(HasSubstr("csv"), HasSubstr("jsonl"), HasSubstr("mcap"),
                                HasSubstr("got \"cvs\""), HasSubstr("nearest: \"csv\"")));
}

TEST_F(LogCommand, WhereNothingIsToBeCopiedTheFileThatIsThereStays) {
  const std::string good = folder_ / "good.lcmlog", text = folder_ / "text.txt";
  std::ofstream(good) << "kept";
  std::ofstream(text) << "no log at all";
  const std::string text2 = folder_ / "text2.txt", other = folder_ / "other.lcmlog",
                    definitions = folder_ / "definitions.lcmlog";
  std::ofstream(text2) << "neither";
  MessageLog(other).Add(0, "POSE", pose_t{});
  MessageLog(definitions).Add(0, "TYPE_TEXT", type_text_t{});
  const std::vector<std::vector<std::string>> wrong{
      {"log", "filter", log_, good, "--force", "--channels", "POZE"},
      {"log", "filter", log_, good, "--force", "--channels", ""},
      {"log", "filter", log_, good, "--force", "--from", "20"},
      {"log", "filter", log_, good, "--force", "--from", "1e300"},
      {"log", "filter", log_, good, "--force", "--to", "-1"},
      {"log", "filter", log_, good, "--force", "--from", "1", "--to", "1"},
      {"log", "filter", log_, good, "--force", "--rename", "POSE"},
      {"log", "filter", log_, good, "--force", "--rename", "POZE=P"},
      {"log", "filter", log_, good, "--force", "--rename", "POSE=FOREIGN"},
      {"log", "filter", log_, good, "--force", "--rename", "POSE=P\xc3\xb6SE"},
      {"log", "repair", text, good, "--force"},
      {"log", "index", text, "--out", good, "--force"},
      {"log", "merge", text, text2, good, "--force", "--offset", "0"},
      {"log", "merge", log_, other, good, "--force", "--offset", "1e10"},
      {"log", "export", text, "jsonl", "--out", good, "--force"},
      {"log", "export", text, "mcap", "--out", good, "--force"},
      {"log", "export", log_, "jsonl", "--out", good, "--force", "--channels", "POZE"},
      {"log", "filter", definitions, good, "--force"},
      {"log", "export", definitions, "jsonl", "--out", good, "--force"}};
  for (const auto& words : wrong) {
    EXPECT_EQ(Priamos(words).exit_code, 2) << testing::PrintToString(words);
    EXPECT_EQ(FileContent(good), "kept") << testing::PrintToString(words);
  }
}

TEST_F(LogCommand, AMinusIsStandardOutputForTextAndNoNameOfALog) {
  EXPECT_EQ(Priamos({"log", "index", log_, "--out", "-"}).out, Priamos({"log", "index", log_}).out);
  EXPECT_EQ(Priamos({"log", "export", log_, "jsonl", "--out", "-"}).out,
            Priamos({"log", "export", log_, "jsonl"}).out);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"log", "filter", log_, "-"},
                                             {"log", "repair", log_, "-"},
                                             {"log", "merge", log_, log_, "-"},
                                             {"log", "export", log_, "csv", "--out", "-"},
                                             {"log", "record", "-"}})
    EXPECT_EQ(Priamos(words).exit_code, 2) << testing::PrintToString(words);
  EXPECT_FALSE(std::filesystem::exists("-"));
}

}  // namespace
}  // namespace priamos::cli
