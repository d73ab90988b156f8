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
  EXPECT_EQ(json::parse(lines[1]).at("phase"), "PASSING");
  EXPECT_EQ(json::parse(lines[1]).at("text"), "passing");
  EXPECT_EQ(json::parse(lines[2]).at("phase"), "DONE");
}

TEST_F(MissionCommand, AFailedMissionIsExitCodeOne) {
  Say(mission_status_t::FAILED, "no way");
  EXPECT_EQ(Ask({"status"}).exit_code, 1);
}

TEST_F(MissionCommand, NothingIsPausedCancelledOrResumedWhereNothingRuns) {
  Say(mission_status_t::DONE, "through");
  EXPECT_EQ(Ask({"pause"}).err, "priamos mission pause: refused: no mission is under way\n");
  EXPECT_EQ(Ask({"resume"}).err, "priamos mission resume: refused: nothing is paused\n");
  const auto answer = Ask({"cancel", "12", "--json"});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_EQ(json::parse(answer.out), json({{"order", "cancel"},
                                           {"id", 12},
                                           {"outcome", "refused"},
                                           {"text", "no order 12 is under way or waits"}}));
}

TEST_F(MissionCommand, TheListShowsWhatRunsWaitsAndHasEnded) {
  mission_status_t status{};
  status.phase = mission_status_t::DRIVING;
  status.text = "driving";
  status.title = "round";
  status.order_id = 12;
  status.running = true;
  status.step = 2;
  status.n_steps = 5;
  status.rounds = 1;
  status.left_s = 42;
  status.waiting.resize(1);
  status.waiting[0].order_id = 13;
  status.waiting[0].title = "door 'laboratory'";
  status.n_waiting = 1;
  status.results.resize(2);
  status.results[0].order_id = 12;
  status.results[0].step = 1;
  status.results[1].order_id = 11;
  status.results[1].outcome = mission_result_t::FAILED;
  status.results[1].took_s = 8;
  status.results[1].text = "blocked";
  status.n_results = 2;
  log_.Add(0, "MISSION_STATUS", status);
  EXPECT_EQ(Ask({"list"}).out,
            "   12  under way  round: driving, step 2 of 5, 42 s left\n"
            "   13  waits      door 'laboratory'\n"
            "   11  failed     blocked (8 s)\n");
  const auto lines = LinesOf(Ask({"list", "--json"}).out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(json::parse(lines[0]).at("left_s"), 42);
  EXPECT_EQ(json::parse(lines[1]).at("outcome"), "waits");
  EXPECT_EQ(json::parse(lines[2]).at("step"), 1);
}

TEST_F(MissionCommand, AFileIsCheckedBeforeAnythingIsSaid) {
  const std::string file = (folder_ / "round.toml").string();
  std::ofstream(file) << "[[step]]\ndo = \"goto\"\nx_m = 4.0\ny_m = 0.2\n";
  const auto answer = Ask({"run", file});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("round.toml:1: the goal (4.00, 0.20) is 0.20 m from wall 'south'"));
}

TEST_F(MissionCommand, APlaceOfAPatrolHasTwoNumbers) {
  Say(mission_status_t::DONE, "through");
  const auto answer = Ask({"patrol", "1", "2", "3"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("expected x and y of each place, got 3 numbers"));
}

TEST_F(MissionCommand, APlaceOfAPatrolInAWallIsRefusedBeforeAnythingIsSaid) {
  Say(mission_status_t::DONE, "through");
  const auto answer = Ask({"patrol", "2", "2.4", "6", "1"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("place 2: the goal (6.00, 1.00)"), HasSubstr("wall")));
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
  EXPECT_THAT(
      answer.err,
      HasSubstr("expected a verb, got none; one of abort, cancel, corridor, door, elevator, explore, goto, "
                "list, locate, patrol, pause, resume, run, status"));
}

}  // namespace
}  // namespace priamos::cli
