#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const std::string kOffboard = PRIAMOS_SOURCE_DIR "/logs/recorded/door-offboard.lcmlog";

PriamosAnswer Verify(const std::string& log, const std::string& module, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"replay", "verify", log, "--module", module};
  words.insert(words.end(), more.begin(), more.end());
  return Priamos(words);
}

TEST(ReplayCommand, TheRecordedPlannerIsEqualInEveryChannel) {
  const auto answer = Verify(kOffboard, "planner", {"--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto dut = json::parse(answer.out);
  EXPECT_TRUE(dut.at("equal"));
  EXPECT_EQ(dut.at("module"), "planner");
  EXPECT_TRUE(dut.at("differences").empty());
  std::set<std::string> names;
  for (const json& channel : dut.at("channels")) {
    EXPECT_EQ(channel.at("recorded"), channel.at("equal")) << channel;
    names.insert(channel.at("channel"));
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"MISSION_STATUS", "LOOK_REQUEST", "PATH"}));
}

TEST(ReplayCommand, ForAPersonItSaysSoInWords) {
  const auto lines = LinesOf(Verify(kOffboard, "planner").out);
  EXPECT_THAT(lines.front(), HasSubstr("messages fed to planner"));
  EXPECT_EQ(lines.back(), "every byte is as it was recorded");
}

TEST(ReplayCommand, AnotherConfigurationIsSeenAsADifference) {
  const auto answer = Verify(kOffboard, "planner", {"--set", "status_rate_hz=5"});
  EXPECT_EQ(answer.exit_code, 1) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("DIFFERENT\n")) << "nothing but messages goes into a planner";
}

TEST(ReplayCommand, ALogWithoutItsMessagesIsRefused) {
  TemporaryFolder folder;
  MessageLog log(folder / "other.lcmlog");
  log.Add(0, "WHEEL_STATE", wheel_state_t{});
  const auto answer = Verify(log.file(), "planner");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(answer.err,
            "priamos replay verify: " + log.file() + ": expected messages that planner sent, got none\n");
}

TEST(ReplayCommand, AFolderWithoutThePicturesOfTheLogIsRefused) {
  const TemporaryFolder folder;
  const auto answer =
      Verify(PRIAMOS_SOURCE_DIR "/logs/recorded/door-onboard.lcmlog", "head", {"--pictures", folder.path()});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr(folder.path()), HasSubstr(".pgm: expected a picture of "),
                                HasSubstr("none of which is there")));
  EXPECT_EQ(LinesOf(answer.err).size(), 1u);
}

TEST(ReplayCommand, OnlyModulesCanBeReplayed) {
  const auto answer = Verify(kOffboard, "plan");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err,
              AllOf(HasSubstr("--module: expected one of robot, planner, head"), HasSubstr("got \"plan\"")));
  const auto none = Priamos({"replay", "verify", kOffboard});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("expected --module (whose messages to compare), got none"));
}

TEST(ReplayCommand, AConfigurationThatIsNotThereIsNamed) {
  const auto answer = Verify(kOffboard, "planner", {"--config", "/no/such/planner.toml"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("/no/such/planner.toml"));
}

TEST(ReplayCommand, AKeyThatTheModuleLacksIsNamed) {
  const auto answer = Verify(kOffboard, "planner", {"--set", "spede=1"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("spede"));
}

/// The example in its help is for a log that is there.
TEST(ReplayCommand, TheLogOfItsExampleIsThere) {
  const std::string help = Priamos({"replay", "verify", "--help"}).out;
  const auto begin = help.find("logs/recorded/"), end = help.find(' ', begin);
  ASSERT_NE(begin, std::string::npos);
  EXPECT_TRUE(
      std::filesystem::exists(std::string(PRIAMOS_SOURCE_DIR) + "/" + help.substr(begin, end - begin)))
      << help.substr(begin, end - begin);
}

}  // namespace
}  // namespace priamos::cli
