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

class MissionCommand : public testing::Test {
 protected:
  void Say(std::int8_t phase, const std::string& text) {
    mission_status_t status{};
    status.phase = phase;
    status.text = text;
    log_.Add(0, "MISSION_STATUS", status);
  }
  PriamosAnswer Ask(std::vector<std::string> words) {
    words.insert(words.begin(), "mission");
    words.insert(words.end(), {"--bus", log_.url()});
    return Priamos(words);
  }
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(MissionCommand, StatusIsWhatThePlannerSays) {
  Say(mission_status_t::APPROACHING, "approaching the door");
  const auto answer = Ask({"status"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.out, "APPROACHING: approaching the door\n");
}

TEST_F(MissionCommand, StatusUntilTheEndTellsEveryPhaseOnce) {
  Say(mission_status_t::APPROACHING, "approaching");
  Say(mission_status_t::APPROACHING, "approaching");
  Say(mission_status_t::PASSING, "passing");
  Say(mission_status_t::DONE, "through");
  const auto answer = Ask({"status", "--wait", "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto lines = LinesOf(answer.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(json::parse(lines[1]), json({{"phase", "PASSING"}, {"text", "passing"}}));
  EXPECT_EQ(json::parse(lines[2]).at("phase"), "DONE");
}

TEST_F(MissionCommand, AFailedMissionIsExitCodeOne) {
  Say(mission_status_t::FAILED, "no way");
  EXPECT_EQ(Ask({"status"}).exit_code, 1);
}

TEST_F(MissionCommand, AnOrderBehindARunningMissionIsRefusedInWords) {
  Say(mission_status_t::PASSING, "passing the door");
  const auto answer = Ask({"door", "laboratory"});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_EQ(answer.out, "");
  EXPECT_EQ(answer.err, "priamos mission door: refused: a mission is under way: passing the door\n");
}

TEST_F(MissionCommand, TheRefusalAsJson) {
  Say(mission_status_t::PASSING, "passing the door");
  const auto answer = Ask({"door", "1", "--json"});
  EXPECT_EQ(json::parse(answer.out), json({{"order", "door"},
                                           {"outcome", "refused"},
                                           {"text", "a mission is under way: passing the door"}}));
}

TEST_F(MissionCommand, AnUnknownDoorIsRefusedBeforeAnythingIsSaid) {
  const auto answer = Ask({"door", "laboratorium"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("unknown door \"laboratorium\""), HasSubstr("\"laboratory\""),
                                HasSubstr(".toml has ")));
}

TEST_F(MissionCommand, AnUnknownDeploymentIsRefusedWithTheKnownOnes) {
  const auto answer = Ask({"door", "laboratory", "--deployment", "simm"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("simm"), HasSubstr("sim"), HasSubstr("robot")));
}

TEST_F(MissionCommand, ADoorHasToBeNamed) {
  const auto answer = Priamos({"mission", "door"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err,
              HasSubstr("priamos mission door: expected door (its name in the map, or its number)"));
}

TEST_F(MissionCommand, WithoutAVerbTheyAreNamed) {
  const auto answer = Priamos({"mission"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("expected a verb, got none; one of abort, door, goto, status"));
}

}  // namespace
}  // namespace priamos::cli
