#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class WhereCommand : public testing::Test {
 protected:
  WhereCommand() {
    pose_t pose{};
    pose.x_m = 2.31;
    log_.Add(0, "POSE", pose);
    drive_status_t drive{};
    drive.mode = drive_status_t::HOLDING;
    log_.Add(0, "DRIVE_STATUS", drive);
    mission_status_t mission{};
    mission.phase = mission_status_t::PASSING;
    mission.text = "passing the door";
    log_.Add(0, "MISSION_STATUS", mission);
  }
  PriamosAnswer Where(std::vector<std::string> more) {
    std::vector<std::string> words{"where", "--bus", log_.url()};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(WhereCommand, EndsAsSoonAsEverythingIsKnown) {
  const auto begin = std::chrono::steady_clock::now();
  const auto answer = Where({});
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1500)) << "the longest wait";
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.err, "");
  EXPECT_THAT(answer.out,
              AllOf(HasSubstr("x 2.31 m"), HasSubstr("HOLDING"), HasSubstr("PASSING: passing the door")));
}

TEST_F(WhereCommand, JsonIsOneDocument) {
  const auto lines = LinesOf(Where({"--json"}).out);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(json::parse(lines[0]).dump(), HasSubstr("2.31"));
}

TEST_F(WhereCommand, TheNewestPoseCounts) {
  pose_t later{};
  later.x_m = -7.25;
  log_.Add(1, "POSE", later);
  EXPECT_THAT(Where({}).out, HasSubstr("x -7.25 m"));
}

TEST_F(WhereCommand, AWordTooMuchIsRefused) {
  const auto answer = Where({"am I"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("priamos where: expected no argument, got \"am I\""));
}

TEST_F(WhereCommand, ABusThatLcmCannotOpenIsNamed) {
  const auto answer = Priamos({"where", "--bus", "carrier-pigeon://"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("carrier-pigeon://"));
}

}  // namespace
}  // namespace priamos::cli
