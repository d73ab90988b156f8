#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class LogRecord : public testing::Test {
 protected:
  LogRecord() {
    heard_.Add(0, "POSE", pose_t{}).Add(0, "WHEEL_STATE", wheel_state_t{}).Add(0.1, "POSE", pose_t{});
  }
  PriamosAnswer Record(std::vector<std::string> more) {
    std::vector<std::string> words{"log", "record", out_, "--seconds", "0.03", "--bus", heard_.url()};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  std::string out_ = folder_ / "new.lcmlog";
  MessageLog heard_{folder_ / "heard.lcmlog"};
};

/// The events of a log, without its definitions of types.
std::vector<bus::LogEvent> MessagesOf(const std::string& log) {
  auto events = EventsOf(log);
  std::erase_if(events, [](const bus::LogEvent& event) { return event.channel == "TYPE_TEXT"; });
  return events;
}

TEST_F(LogRecord, WritesWhatItHearsAndSaysWhere) {
  const auto answer = Record({});
  EXPECT_EQ(answer.exit_code, 0);
  const auto lines = LinesOf(answer.out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], out_);
  EXPECT_THAT(lines[1], StartsWith("6 events, "));
  const auto events = MessagesOf(out_);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].channel, "WHEEL_STATE");
  EXPECT_EQ(events[2].bytes, EventsOf(heard_.file())[2].bytes) << "byte for byte";
}

TEST_F(LogRecord, JsonIsTheCountAlone) {
  const auto dut = json::parse(Record({"--json"}).out);
  EXPECT_EQ(dut.at("events"), 6) << "each type is defined before its message";
  EXPECT_EQ(dut.at("lost_network"), 0);
  EXPECT_EQ(dut.at("lost_disk"), 0);
  EXPECT_EQ(dut.at("alarm"), "");
  EXPECT_EQ(dut.at("bytes"), FileContent(out_).size());
}

TEST_F(LogRecord, ChosenChannelsOnly) {
  EXPECT_EQ(json::parse(Record({"--json", "--channels", "WHEEL_*,HEALTH"}).out).at("events"), 2);
}

TEST_F(LogRecord, WithoutIsStrongerThanChannels) {
  EXPECT_EQ(json::parse(Record({"--json", "--channels", "*", "--without", "POSE"}).out).at("events"), 2);
}

TEST_F(LogRecord, ItsSignOfLifeIsOnTheBusUnlessItIsTold) {
  const std::vector<std::string> words{"log", "record", out_, "--seconds", "0.06", "--bus", "memq://"};
  EXPECT_EQ(Priamos(words).exit_code, 0);
  const auto events = MessagesOf(out_);
  ASSERT_EQ(events.size(), 1u) << "it hears itself on a bus of its own";
  EXPECT_EQ(events[0].channel, "HEALTH");
  health_t health{};
  ASSERT_GT(health.decode(events[0].bytes.data(), 0, static_cast<int>(events[0].bytes.size())), 0);
  EXPECT_EQ(health.process, "recorder");
  EXPECT_EQ(health.state, health_t::OK);
  EXPECT_EQ(health.messages_lost, 0);
  auto silent = words;
  silent[2] = folder_ / "silent.lcmlog";
  silent.push_back("--no-health");
  EXPECT_EQ(Priamos(silent).exit_code, 0);
  EXPECT_TRUE(EventsOf(silent[2]).empty());
}

TEST_F(LogRecord, ALogThatIsThereIsKept) {
  std::ofstream(out_) << "there";
  const auto answer = Record({});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(answer.err, "priamos log record: " + out_ + ": expected a new file, got an existing one\n");
  EXPECT_EQ(FileContent(out_), "there");
}

TEST_F(LogRecord, NumbersBelowZeroAreRefused) {
  for (const char* option : {"--split-mb", "--split-minutes", "--keep", "--keep-free-mb", "--seconds"}) {
    const auto answer = Record({option, "-1"});
    EXPECT_EQ(answer.exit_code, 2) << option;
    EXPECT_THAT(answer.err, AllOf(HasSubstr(option), HasSubstr("number"))) << option;
  }
  EXPECT_FALSE(std::filesystem::exists(out_));
}

class LogPlay : public testing::Test {
 protected:
  PriamosAnswer Play(std::vector<std::string> more) {
    std::vector<std::string> words{"log", "play", log_.file(), "--speed", "max", "--bus", SinkUrl(sent_)};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  std::string sent_ = folder_ / "sent.lcmlog";
  MessageLog log_{folder_ / "run.lcmlog"};
};

TEST_F(LogPlay, SendsEveryEventInOrderUnderItsNewName) {
  for (int i = 0; i < 120; ++i) log_.Add(i, i % 2 ? "POSE" : "WHEEL_STATE", pose_t{});
  const auto answer = Play({"--rename", "POSE=POSE_OLD"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out, "120 events sent, 0 refused, 0 damaged bytes skipped\n");
  const auto sent = EventsOf(sent_), recorded = EventsOf(log_.file());
  ASSERT_EQ(sent.size(), 120u);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(sent[i].channel, i % 2 ? "POSE_OLD" : "WHEEL_STATE");
    EXPECT_EQ(sent[i].bytes, recorded[i].bytes);
  }
}

TEST_F(LogPlay, ClaimsOfProcessesThatDoNotRunAreNotSent) {
  log_.Add(0, "CLAIM", claim_t{}).Add(0, "POSE", pose_t{});
  EXPECT_EQ(json::parse(Play({"--json"}).out).at("sent"), 1);
  EXPECT_EQ(EventsOf(sent_).at(0).channel, "POSE");
}

TEST_F(LogPlay, LongMessagesAreRefusedUnlessFragmentsAreAllowed) {
  log_.AddBytes(0, "LONG", std::vector<std::byte>(1401)).AddBytes(0, "JUST", std::vector<std::byte>(1400));
  const auto refused = Play({});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.out, HasSubstr("1 event sent, 1 refused"));
  EXPECT_THAT(refused.err, HasSubstr("longer than an unfragmented message; --fragments sends them"));
  const auto sent = Play({"--fragments", "--json"});
  EXPECT_EQ(sent.exit_code, 0);
  EXPECT_EQ(json::parse(sent.out).at("sent"), 2);
}

TEST_F(LogPlay, ASpeedBeyondItsBoundsIsNamed) {
  log_.Add(0, "POSE", pose_t{});
  for (const char* speed : {"1/65", "1001", "fast", "-1"}) {
    const auto answer = Priamos({"log", "play", log_.file(), "--bus", "memq://", "--speed", speed});
    EXPECT_EQ(answer.exit_code, 2) << speed;
    EXPECT_THAT(answer.err, HasSubstr("--speed: expected 1/64 to 1000 or max")) << speed;
    EXPECT_THAT(answer.err, HasSubstr(speed));
  }
}

TEST_F(LogPlay, WhereNothingIsToBePlayedThatIsSaid) {
  const auto empty = Play({"--loop"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_EQ(empty.err, "priamos log play: " + log_.file() +
                           ": expected events to play, got none; next: priamos log info " + log_.file() +
                           "\n");
  log_.Add(0, "POSE", pose_t{});
  EXPECT_EQ(Play({"--without", "POSE"}).exit_code, 2);
}

TEST_F(LogPlay, FragmentsAreNoAdviceToWhoHasThem) {
  log_.AddBytes(0, "LONG", std::vector<std::byte>(65 << 10));
  const auto answer = Priamos({"log", "play", log_.file(), "--speed", "max", "--fragments", "--bus",
                               "file:///nowhere/sent.lcmlog?mode=w"});
  EXPECT_THAT(answer.err, testing::Not(HasSubstr("--fragments sends them")));
}

}  // namespace
}  // namespace priamos::cli
