#include "cli/front/estop_command.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Statuses of a robot, as a bus on which nobody hears what is said.
class EstopCommand : public testing::Test {
 protected:
  /// `utime` is when the status was made, by the clock of the robot.
  void Status(std::int64_t utime, bool latched) {
    drive_status_t status{};
    status.utime = utime;
    status.estop = latched;
    log_.AddBytes(0, "DRIVE_STATUS", bus::Encode(status));
  }
  PriamosAnswer Estop(std::vector<std::string> more) {
    std::vector<std::string> words{"estop", "--bus", log_.url(), "--wait", "0.1"};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  static constexpr std::int64_t kAfterwards = 4'000'000'000'000'000;  ///< in the year 2096
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(EstopCommand, IsConfirmedByAStatusOfAfterwardsThatIsLatched) {
  Status(kAfterwards, true);
  const auto answer = Estop({});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, StartsWith("e-stop is latched after 0.0"));
}

TEST_F(EstopCommand, AStatusFromBeforeProvesNothing) {
  Status(MessageLog::UtimeAt(0), true);
  EXPECT_EQ(Estop({}).exit_code, 1);
}

TEST_F(EstopCommand, AStatusThatIsNotLatchedProvesNothing) {
  Status(kAfterwards, false);
  const auto answer = Estop({});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.err, AllOf(StartsWith("priamos estop: the robot did not answer within 0.1 s on file://"),
                                HasSubstr("DRIVE_STATUS is heard, but shows no change")));
}

TEST_F(EstopCommand, RearmingIsConfirmedByAStatusThatIsNotLatched) {
  Status(kAfterwards, false);
  const auto answer = Estop({"--rearm"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, StartsWith("re-armed after"));
}

TEST_F(EstopCommand, JsonSaysWhatWasAskedAndWhetherItIsSo) {
  Status(kAfterwards, true);
  const auto stopped = json::parse(Estop({"--json"}).out);
  EXPECT_EQ(stopped.at("action"), "STOP");
  EXPECT_EQ(stopped.at("confirmed"), true);
  EXPECT_LT(stopped.at("after_s"), 0.1);
  const auto refused = Estop({"--rearm", "--json"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(json::parse(refused.out),
            json({{"action", "REARM"}, {"confirmed", false}, {"after_s", nullptr}}));
}

TEST_F(EstopCommand, ItWaitsForATenthOfASecondAtLeast) {
  for (const char* seconds : {"0", "-1", "601", "inf", "soon"}) {
    const auto answer = Priamos({"estop", "--bus", "memq://", "--wait", seconds});
    EXPECT_EQ(answer.exit_code, 2) << seconds;
    EXPECT_THAT(answer.err, HasSubstr("--wait: expected a number, 0.1 to 600"));
  }
}

}  // namespace
}  // namespace priamos::cli
