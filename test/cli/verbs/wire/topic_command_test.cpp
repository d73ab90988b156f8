#include <gmock/gmock.h>

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

class TopicCommand : public testing::Test {
 protected:
  TopicCommand() {
    for (int i = 0; i < 3; ++i) log_.Add(i, "POSE", pose_t{});
    log_.Add(3, "DRIVE_STATUS", drive_status_t{});
    log_.AddBytes(4, "FOREIGN", std::vector<std::byte>(9, std::byte{1}));
  }
  PriamosAnswer Table(const std::string& verb, std::vector<std::string> more) {
    std::vector<std::string> words{"topic", verb, "--seconds", "0.1", "--bus", log_.url()};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  PriamosAnswer Pub(const std::string& channel, const std::string& type, const std::string& message) {
    return Priamos({"topic", "pub", channel, type, message, "--bus", SinkUrl(sent_)});
  }
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
  std::string sent_ = folder_ / "sent.lcmlog";
};

TEST_F(TopicCommand, ListCountsEveryChannelWithItsType) {
  const auto answer = Table("list", {"--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto dut = json::parse(answer.out);
  EXPECT_EQ(dut.at("lost"), 0);
  const auto& channels = dut.at("channels");
  ASSERT_EQ(channels.size(), 3u);
  EXPECT_EQ(channels[0].at("channel"), "DRIVE_STATUS");
  EXPECT_EQ(channels[1].at("type"), "?") << "no type of ours";
  EXPECT_EQ(channels[1].at("undecodable"), 1);
  EXPECT_EQ(channels[2].at("messages"), 3);
  EXPECT_EQ(channels[2].at("largest_bytes"), 112);
}

TEST_F(TopicCommand, ListForAPersonIsATable) {
  const auto lines = LinesOf(Table("list", {}).out);
  ASSERT_GT(lines.size(), 3u);
  EXPECT_THAT(lines[0], StartsWith("channel "));
  EXPECT_THAT(lines[3], AllOf(StartsWith("POSE "), HasSubstr("priamos.pose_t")));
}

TEST_F(TopicCommand, HzAndBwAreAboutOneChannel) {
  for (const char* verb : {"hz", "bw"}) {
    const auto dut = json::parse(Table(verb, {"POSE", "--json"}).out).at("channels");
    ASSERT_EQ(dut.size(), 1u) << verb;
    EXPECT_EQ(dut[0].at("channel"), "POSE") << verb;
  }
}

TEST_F(TopicCommand, OnAChannelWithoutMessagesTheNearestIsNamedAndTheCodeIsOne) {
  const auto answer = Table("hz", {"POZE", "--json"});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_TRUE(json::parse(answer.out).at("channels").empty());
  EXPECT_THAT(answer.err, AllOf(StartsWith("priamos topic hz: nobody publishes POZE on file://"),
                                HasSubstr("nearest: \"POSE\"")));
}

TEST_F(TopicCommand, SecondsHaveBounds) {
  for (const char* seconds : {"0", "3601", "-2", "two"}) {
    const auto answer = Table("list", {"--seconds", seconds});
    EXPECT_EQ(answer.exit_code, 2) << seconds;
    EXPECT_THAT(answer.err, AllOf(HasSubstr("--seconds"), HasSubstr(seconds)));
  }
  EXPECT_THAT(Priamos({"topic", "list", "--help"}).out, HasSubstr("--seconds FLOAT:FLOAT in [0.1 - 3600]=2"));
}

TEST_F(TopicCommand, UrlIsThatOfTheChosenBus) {
  EXPECT_EQ(Priamos({"topic", "url", "--bus", "memq://"}).out, "memq://\n");
  const auto onboard = Priamos({"topic", "url", "--bus", "onboard", "--robot", "hall9", "--ttl", "3"});
  EXPECT_THAT(onboard.out, AllOf(StartsWith("udpm://239.255."), HasSubstr("?ttl=3\n")));
  const auto offboard = Priamos({"topic", "url", "--robot", "hall9", "--ttl", "3"});
  EXPECT_NE(onboard.out, offboard.out) << "offboard is the default, and another port";
  const auto dut = json::parse(Priamos({"topic", "url", "--bus", "memq://", "--json"}).out);
  EXPECT_EQ(dut, json({{"url", "memq://"}}));
}

TEST_F(TopicCommand, LcmsOwnProgramsAreToldNoNetworkButTheRouteThatDoesTheSame) {
  const auto answer = Priamos({"topic", "url", "--robot", "hall9", "--network", "127.0.0.1"});
  EXPECT_EQ(answer.out, Priamos({"topic", "url", "--robot", "hall9"}).out);
  EXPECT_THAT(answer.err, testing::ContainsRegex("next: sudo ip route add 239.255.[0-9]+.68/32 dev lo\n"));
}

TEST_F(TopicCommand, ATtlBeyondAByteIsRefused) {
  const auto answer = Priamos({"topic", "url", "--ttl", "256"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--ttl: expected a whole number, 0 to 255, got \"256\""));
}

TEST_F(TopicCommand, PubSendsTheMessageAsItsTypeHasIt) {
  const auto answer = Pub("LINK_REQUEST", "link_request_t", R"({"utime":5,"channel":"POSE","hold_s":2.5})");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.err, "");
  const auto events = EventsOf(sent_);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].channel, "LINK_REQUEST");
  link_request_t dut{};
  ASSERT_GT(dut.decode(events[0].bytes.data(), 0, static_cast<int>(events[0].bytes.size())), 0);
  EXPECT_EQ(dut.utime, 5);
  EXPECT_EQ(dut.channel, "POSE");
  EXPECT_EQ(dut.hold_s, 2.5);
}

TEST_F(TopicCommand, PubWarnsOfAChannelThatNobodyHears) {
  const std::string estop = R"({"utime":5,"action":1,"driver":0})";
  const auto answer = Pub("ESTOPP", "estop_t", estop);
  EXPECT_EQ(answer.exit_code, 0) << "it is sent all the same";
  EXPECT_THAT(answer.err, AllOf(HasSubstr("\"ESTOPP\" is no channel of PRIAMOS; nearest: \"ESTOP\"")));
  EXPECT_EQ(EventsOf(sent_).size(), 1u);
}

TEST_F(TopicCommand, PubWarnsOfAnUnknownChannelInsideALinkRequest) {
  const auto answer = Pub("LINK_REQUEST", "link_request_t", R"({"utime":0,"channel":"SONAR","hold_s":1})");
  EXPECT_THAT(answer.err, HasSubstr("\"SONAR\" is no channel of PRIAMOS; nearest: \"SONAR_RANGES\""));
}

TEST_F(TopicCommand, PubRefusesWhatIsNoMessage) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"{", "message: expected JSON, got {"},
      {R"({"utime":1e999,"action":1,"driver":0})", "expected numbers of at most 1.8e308"},
      {R"({"utime":5,"action":1})", "driver"},
      {R"({"utime":5,"action":"STOP!","driver":0})", "action"},
      {R"({"utime":5,"action":1,"driver":0,"speed":1})", "speed"}};
  for (const auto& [message, sentence] : wrong) {
    const auto answer = Pub("ESTOP", "estop_t", message);
    EXPECT_EQ(answer.exit_code, 2) << message;
    EXPECT_THAT(answer.err, AllOf(StartsWith("priamos topic pub: "), HasSubstr(sentence)));
  }
  EXPECT_TRUE(EventsOf(sent_).empty());
}

TEST_F(TopicCommand, PubNamesTheNearestType) {
  const auto answer = Pub("ESTOP", "estopp_t", "{}");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("unknown type \"estopp_t\"; nearest: \"estop_t\""));
}

TEST_F(TopicCommand, AnEmptyChannelIsNone) {
  for (const char* verb : {"hz", "bw", "echo"}) {
    const auto answer = Priamos({"topic", verb, "", "--bus", "memq://"});
    EXPECT_EQ(answer.exit_code, 2) << verb;
    EXPECT_THAT(answer.err, HasSubstr("expected channel (LCM channel), got \"\"")) << verb;
  }
}

}  // namespace
}  // namespace priamos::cli
