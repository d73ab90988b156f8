#include "console/console_messages.hpp"

#include <gmock/gmock.h>

namespace priamos::console {
namespace {

using Kind = MissionOrder::Kind;

constexpr int kSession = 7;
const Time kNow = FromUtime(1'000'000'000);
const Sender kSender{kSession, 300};

TEST(ConsoleMessages, CommandsNameTheStationItsSessionAndTheirNumber) {
  const auto drive = ToMessage(Twist2{0.3, -0.1, 0.2}, kSender, 0.25, kNow);
  EXPECT_EQ(drive.driver, lease_request_t::CONSOLE);
  EXPECT_EQ(drive.session, kSession);
  EXPECT_EQ(drive.sequence, 300);
  EXPECT_EQ(drive.utime, ToUtime(kNow));
  EXPECT_EQ(drive.time_to_live_s, 0.25);
  EXPECT_EQ(drive.vx_m_s, 0.3);
  EXPECT_EQ(drive.vy_m_s, -0.1);
  EXPECT_EQ(drive.wz_rad_s, 0.2);
  HeadRates rates;
  rates.pan_rad_s = 0.5;
  rates.zoom_step_s = -3;
  const auto head = ToMessage(rates, kSender, 0.25, kNow);
  EXPECT_EQ(head.session, kSession);
  EXPECT_EQ(head.sequence, 300);
  EXPECT_EQ(head.pan_rad_s, 0.5);
  EXPECT_EQ(head.zoom_step_s, -3);
}

TEST(ConsoleMessages, LeaseAndStopAreOfTheStation) {
  const auto asks = ToMessage(PilotOutput::Lease::kAcquire, kSender, kNow);
  EXPECT_EQ(asks.action, lease_request_t::ACQUIRE);
  EXPECT_EQ(asks.driver, lease_request_t::CONSOLE);
  EXPECT_EQ(asks.session, kSession);
  EXPECT_EQ(ToMessage(PilotOutput::Lease::kTakeOver, kSender, kNow).action, lease_request_t::TAKE_OVER);
  EXPECT_EQ(ToMessage(PilotOutput::Estop::kStop, kNow).action, estop_t::STOP);
  EXPECT_EQ(ToMessage(PilotOutput::Estop::kRearm, kNow).action, estop_t::REARM);
}

TEST(ConsoleMessages, AMissionWithoutAGoalHasNone) {
  for (const auto& [kind, mission] : {std::pair{Kind::kAbort, mission_command_t::ABORT},
                                      {Kind::kPause, mission_command_t::PAUSE},
                                      {Kind::kResume, mission_command_t::RESUME},
                                      {Kind::kExplore, mission_command_t::EXPLORE},
                                      {Kind::kLocate, mission_command_t::LOCATE}}) {
    MissionOrder order;
    order.kind = kind;
    const auto message = ToMessage(order, kNow);
    EXPECT_EQ(message.mission, mission);
    EXPECT_FALSE(message.turn);
    EXPECT_EQ(message.n_steps, 0);
  }
}

TEST(ConsoleMessages, AMissionHasItsGoalDoorOrNumber) {
  MissionOrder order;
  order.kind = Kind::kGoto;
  order.goal = Target{{4.5, -1, 0.5}, false};
  auto message = ToMessage(order, kNow);
  EXPECT_EQ(message.mission, mission_command_t::GOTO);
  EXPECT_EQ(message.x_m, 4.5);
  EXPECT_EQ(message.y_m, -1);
  EXPECT_EQ(message.yaw_rad, 0.5);
  EXPECT_FALSE(message.turn);
  order.kind = Kind::kCorridor;
  order.goal = Target{{0, 0, 1.5}};
  order.distance_m = 20;
  message = ToMessage(order, kNow);
  EXPECT_EQ(message.mission, mission_command_t::CORRIDOR);
  EXPECT_TRUE(message.turn);
  EXPECT_EQ(message.distance_m, 20);
  MissionOrder door;
  door.kind = Kind::kPassDoor;
  door.landmark_id = 3;
  EXPECT_EQ(ToMessage(door, kNow).landmark_id, 3);
  MissionOrder cancel;
  cancel.kind = Kind::kCancel;
  cancel.order_id = 65535;
  EXPECT_EQ(ToMessage(cancel, kNow).order_id, 65535);
}

TEST(ConsoleMessages, APatrolIsStepsInTurn) {
  MissionOrder order;
  order.kind = Kind::kPatrol;
  order.places = {Target{{1, 2, 0}, false}, Target{{3, 4, 1}}};
  order.rounds = 0;
  const auto message = ToMessage(order, kNow);
  EXPECT_EQ(message.mission, mission_command_t::RUN);
  EXPECT_EQ(message.rounds, 0);
  ASSERT_EQ(message.n_steps, 2);
  EXPECT_EQ(message.steps[0].mission, mission_command_t::GOTO);
  EXPECT_FALSE(message.steps[0].turn);
  EXPECT_EQ(message.steps[1].x_m, 3);
  EXPECT_EQ(message.steps[1].yaw_rad, 1);
  EXPECT_TRUE(message.steps[1].turn);
}

TEST(ConsoleMessages, AnAimLeavesAsItIsWhatHasNoValue) {
  const auto message = ToMessage(AimOrder{0.5, -0.2, {}, 40, {}}, kNow);
  EXPECT_EQ(message.pan_rad, 0.5);
  EXPECT_EQ(message.tilt_rad, -0.2);
  EXPECT_EQ(message.vergence_rad, -1);
  EXPECT_EQ(message.zoom_step, 40);
  EXPECT_EQ(message.focus_step, -1);
}

TEST(ConsoleMessages, AnAlarmIsAcknowledgedBySomebodyAsFarAsTheNameFits) {
  const auto message = ToMessage(AlarmSeen{"head", 5}, std::string(60, 'n'), kNow);
  EXPECT_EQ(message.source, "head");
  EXPECT_EQ(message.utime_alarm, 5);
  EXPECT_EQ(message.by, std::string(40, 'n'));
}

TEST(ConsoleMessages, APlaceIsAsSureAsAPersonCanTell) {
  const auto message = ToMessage(PlaceOrder{{1, 2, 3}}, 9, {0.15, 5}, kNow);
  EXPECT_EQ(message.request_id, 9);
  EXPECT_EQ(message.x_m, 1);
  EXPECT_EQ(message.y_m, 2);
  EXPECT_EQ(message.yaw_rad, 3);
  EXPECT_EQ(message.sigma_m, 0.15);
  EXPECT_NEAR(message.sigma_yaw_rad, 0.0873, 1e-4);
}

TEST(ConsoleMessages, TheLeaseIsMineWhenDriverAndSessionAre) {
  drive_status_t status{};
  status.utime = ToUtime(kNow);
  status.estop = true;
  status.driver = lease_request_t::CONSOLE;
  status.session = kSession;
  const RobotView mine = FromMessage(status, kSession);
  EXPECT_EQ(mine.lease, RobotView::Lease::kMine);
  EXPECT_EQ(mine.heard, kNow);
  EXPECT_TRUE(mine.estop);
  EXPECT_EQ(FromMessage(status, kSession + 1).lease, RobotView::Lease::kOther);
  status.driver = lease_request_t::TELEOP;
  EXPECT_EQ(FromMessage(status, kSession).lease, RobotView::Lease::kOther)
      << "teleop, in a session of that number";
  status.driver = lease_request_t::NOBODY;
  EXPECT_EQ(FromMessage(status, kSession).lease, RobotView::Lease::kFree);
}

}  // namespace
}  // namespace priamos::console
