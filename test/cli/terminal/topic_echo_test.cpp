#include "cli/terminal/topic_echo.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class TopicEcho : public testing::Test {
 protected:
  TopicEcho() {
    for (int i = 0; i < 4; ++i) {
      pose_t pose{};
      pose.x_m = i + 0.5;
      pose.y_m = -i;
      log_.Add(i, "POSE", pose);
    }
    sonar_ranges_t sonar{};
    for (int i = 0; i < 24; ++i) sonar.range_m[i] = 0.1 * i;
    log_.Add(4, "SONAR_RANGES", sonar);
  }
  PriamosAnswer Echo(std::vector<std::string> more) {
    std::vector<std::string> words{"topic", "echo", "--bus", log_.url()};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(TopicEcho, EndsAfterSoManyMessages) {
  const auto answer = Echo({"POSE", "x_m", "--count", "3"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(LinesOf(answer.out), ElementsAre("0.5", "1.5", "2.5"));
}

TEST_F(TopicEcho, AWholeMessageIsJsonOverSeveralLinesOrInOne) {
  const auto person = Echo({"POSE", "--count", "1"});
  EXPECT_GT(LinesOf(person.out).size(), 10u);
  const auto program = Echo({"POSE", "--count", "1", "--json"});
  ASSERT_EQ(LinesOf(program.out).size(), 1u);
  EXPECT_EQ(json::parse(person.out), json::parse(program.out));
  EXPECT_EQ(json::parse(program.out).at("x_m"), 0.5);
}

TEST_F(TopicEcho, SeveralFieldsAreNamedInEveryLine) {
  const auto lines = LinesOf(Echo({"POSE", "x_m", "y_m", "--count", "2"}).out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(json::parse(lines[1]), json({{"x_m", 1.5}, {"y_m", -1}}));
}

TEST_F(TopicEcho, OneFieldAsJsonIsNamedToo) {
  EXPECT_EQ(json::parse(Echo({"POSE", "x_m", "--count", "1", "--json"}).out), json({{"x_m", 0.5}}));
}

TEST_F(TopicEcho, AnElementOfAnArrayIsAField) {
  EXPECT_DOUBLE_EQ(std::stod(Echo({"SONAR_RANGES", "range_m[3]", "--count", "1"}).out), 0.1 * 3);
}

TEST_F(TopicEcho, AFieldThatTheTypeLacksIsRefusedWithTheNearest) {
  const auto answer = Echo({"POSE", "x_mm"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(StartsWith("priamos topic echo: "), HasSubstr("x_mm"), HasSubstr("\"x_m\"")));
  EXPECT_EQ(answer.out, "");
}

TEST_F(TopicEcho, OnAForeignChannelTheFirstMessageTellsWhichFieldsThereAre) {
  log_.Add(5, "MINE", estop_t{});
  EXPECT_EQ(Echo({"MINE", "action", "--count", "1"}).out, "0\n");
  const auto answer = Echo({"MINE", "acton"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("\"action\""));
}

TEST_F(TopicEcho, AMessageThatCannotBeReadIsToldAndCounts) {
  log_.AddBytes(5, "FOREIGN", std::vector<std::byte>(9, std::byte{1}));
  const auto answer = Echo({"FOREIGN", "--count", "1"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out, "");
  EXPECT_EQ(answer.err,
            "FOREIGN: 9 bytes: no known type has this fingerprint; name its .lcm folder with --types\n");
}

TEST_F(TopicEcho, ACutMessageDoesNotEndIt) {
  auto cut = bus::Encode(estop_t{});
  cut.pop_back();
  log_.AddBytes(5, "ESTOP", cut).Add(6, "ESTOP", estop_t{});
  const auto answer = Echo({"ESTOP", "driver", "--count", "2"});
  EXPECT_EQ(answer.out, "0\n");
  EXPECT_THAT(answer.err, StartsWith("ESTOP: 17 bytes: "));
}

TEST_F(TopicEcho, ACountBelowZeroIsRefused) {
  const auto answer = Echo({"POSE", "--count", "-1"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--count: expected a whole number, 0 to"));
}

}  // namespace
}  // namespace priamos::cli
