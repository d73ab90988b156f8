#include "cli/supervise/robot_owner.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"

namespace priamos::cli {
namespace {

alarm_t Alarm(int severity) {
  alarm_t alarm{};
  alarm.severity = static_cast<std::int8_t>(severity);
  alarm.source = "head";
  alarm.text = "the left camera is dark";
  return alarm;
}

TEST(AlarmText, SaysHowBadItIsWhoSaysItAndWhat) {
  EXPECT_EQ(AlarmText(Alarm(alarm_t::CAUTION)), "ALARM (caution) of head: the left camera is dark");
  EXPECT_EQ(AlarmText(Alarm(alarm_t::WARNING)), "ALARM (warning) of head: the left camera is dark");
  EXPECT_EQ(AlarmText(Alarm(alarm_t::CRITICAL)), "ALARM (critical) of head: the left camera is dark");
}

TEST(AlarmText, ASeverityThatNobodyKnowsIsTheNearestKnownOne) {
  EXPECT_EQ(AlarmText(Alarm(3)), AlarmText(Alarm(alarm_t::CRITICAL)));
  EXPECT_EQ(AlarmText(Alarm(127)), AlarmText(Alarm(alarm_t::CRITICAL)));
  EXPECT_EQ(AlarmText(Alarm(-128)), AlarmText(Alarm(alarm_t::CAUTION)));
}

/// Where nothing is started nobody is asked, so this needs no network.
TEST(RobotOwner, OfADeploymentThatStartsNothingHasNoBusToLose) {
  Deployment deployment;
  deployment.processes.resize(1);
  deployment.processes[0].module = "robot";
  deployment.processes[0].bus = "onboard";
  deployment.group = "offboard";
  const bus::Schema schema = bus::OwnTypes();
  const bus::MonotonicClock clock;
  int said = 0;
  RobotOwner dut(deployment, schema, clock, [&](const std::string&) { ++said; });
  dut.Listen();
  EXPECT_FALSE(dut.lost());
  EXPECT_TRUE(dut.alarms().empty());
  EXPECT_EQ(said, 0);
}

}  // namespace
}  // namespace priamos::cli
