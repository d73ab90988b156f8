#include "cli/pages/report_of_log.hpp"

#include <gmock/gmock.h>

#include "bus/log/log_writer.hpp"
#include "bus/node.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kBegin = 5'000'000;

class ReportOfLogTest : public testing::Test {
 protected:
  template <class T>
  static void Write(bus::LogWriter& log, double t_s, std::string_view channel, T message) {
    message.utime = kBegin + std::int64_t(t_s * 1e6);
    log.Write(message.utime, channel, bus::Encode(message));
  }

  /// The workstation's log of a drive of 2 m, of which the robot corrected 0.5 m, and of two orders.
  std::string Workstation() {
    const std::string path = folder_ / "offboard.lcmlog";
    bus::LogWriter log(path);
    for (int i = 0; i <= 40; ++i) {
      pose_t pose{};
      pose.x_m = 1 + 0.05 * i + (i >= 20 ? 0.5 : 0);
      pose.y_m = 2;
      pose.vx_m_s = 0.25;
      pose.sigma_x_m = pose.sigma_y_m = 0.1;
      Write(log, 0.2 * i, "POSE", pose);
    }
    Order(log, 1, 8.2, mission_status_t::DONE, "to (3, 2)", "arrived");
    Order(log, 2, 9.2, mission_status_t::FAILED, "door <laboratory>", "a chair & a table stand in the way");
    alarm_t alarm{};
    alarm.severity = alarm_t::WARNING;
    alarm.source = "robot";
    alarm.text = "sonar 3 is silent";
    Write(log, 3, "ALARM", alarm);
    alarm_ack_t ack{};
    ack.source = "robot";
    ack.utime_alarm = kBegin + 3'000'000;
    ack.by = "Jo";
    Write(log, 4, "ALARM_ACK", ack);
    log.Flush();
    return path;
  }

  static void Order(bus::LogWriter& log, int id, double t_s, int phase, const char* title, const char* text) {
    mission_status_t status{};
    status.order_id = id;
    status.title = title;
    status.text = "driving";
    status.running = true;
    status.phase = mission_status_t::DRIVING;
    Write(log, t_s - 1, "MISSION_STATUS", status);
    status.running = false;
    status.phase = static_cast<std::int8_t>(phase);
    status.text = text;
    Write(log, t_s, "MISSION_STATUS", status);
    Write(log, t_s + 0.1, "MISSION_STATUS", status);
  }

  TemporaryFolder folder_;
};

TEST_F(ReportOfLogTest, TellsHowMissionsEndedAndWhatWasDriven) {
  const std::string page = LogPage("a day", RecordOfLogs({Workstation()}), std::nullopt);
  EXPECT_THAT(page, AllOf(HasSubstr("1 of 2 missions done"), HasSubstr("verdict bad"),
                          HasSubstr("<b>2.0 m</b>"), HasSubstr("<b>9 s</b>")));
  EXPECT_THAT(page, HasSubstr("door &lt;laboratory&gt;: a chair &amp; a table stand in the way"));
  EXPECT_THAT(page,
              HasSubstr("<td>3.0 s</td><td>warning</td><td>robot</td><td>sonar 3 is silent</td><td>Jo</td>"));
  EXPECT_THAT(page, AllOf(HasSubstr("believed speed"), Not(HasSubstr("gap to the nearest"))));
}

TEST_F(ReportOfLogTest, WithTheRobotsLogThePosesAreThatOnes) {
  const std::string onboard = folder_ / "onboard.lcmlog";
  {
    bus::LogWriter log(onboard);
    Write(log, 0, "WHEEL_STATE", wheel_state_t{});
    for (int i = 0; i < 100; ++i) Write(log, 0.1 * i, "POSE", pose_t{});
    log.Flush();
  }
  const RunRecord record = RecordOfLogs({onboard, Workstation()});
  EXPECT_EQ(record.poses.size(), 100U);
  EXPECT_EQ(record.pose_ages_s.size(), 41U);
  EXPECT_EQ(record.alarms.size(), 1U) << "of the workstation";
  EXPECT_EQ(RecordOfLogs({Workstation()}).alarms.size(), 1U);
  EXPECT_EQ(RecordOfLogs({onboard}).poses.size(), 100U);
}

TEST_F(ReportOfLogTest, ALogOfSomethingElseIsRefused) {
  const std::string other = folder_ / "other.lcmlog";
  {
    bus::LogWriter log(other);
    Write(log, 0, "SOMETHING", pose_t{});
    log.Flush();
  }
  try {
    RecordOfLogs({other});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("other.lcmlog: expected messages of a robot"), HasSubstr("next:")));
  }
}

}  // namespace
}  // namespace priamos::cli
