#include "teleop/teleop_messages.hpp"

#include <gtest/gtest.h>

namespace priamos::teleop {
namespace {

const Time kNow = FromUtime(5'000'000);

TEST(TeleopMessages, ACommandCarriesItsSenderAndItsLife) {
  const auto message = ToMessage(Twist2{0.1, -0.2, 0.3}, Sender{7, 65535}, 0.2, kNow);
  EXPECT_EQ(message.utime, 5'000'000);
  EXPECT_EQ(message.driver, lease_request_t::TELEOP);
  EXPECT_EQ(message.session, 7);
  EXPECT_EQ(message.sequence, 65535);
  EXPECT_EQ(message.time_to_live_s, 0.2);
  EXPECT_EQ(message.vx_m_s, 0.1);
  EXPECT_EQ(message.vy_m_s, -0.2);
  EXPECT_EQ(message.wz_rad_s, 0.3);
}

TEST(TeleopMessages, TheLeaseIsOursOnlyByDriverAndSession) {
  drive_status_t message{};
  message.driver = lease_request_t::TELEOP;
  message.session = 7;
  EXPECT_EQ(FromMessage(message, 7).lease, RobotView::Lease::kMine);
  EXPECT_EQ(FromMessage(message, 8).lease, RobotView::Lease::kOther);
  message.driver = lease_request_t::CONSOLE;
  EXPECT_EQ(FromMessage(message, 7).lease, RobotView::Lease::kOther);
  message.driver = lease_request_t::NOBODY;
  EXPECT_EQ(FromMessage(message, 7).lease, RobotView::Lease::kFree);
}

TEST(TeleopMessages, ActsHaveTheirCodes) {
  EXPECT_EQ(ToMessage(PilotOutput::Lease::kAcquire, {}, kNow).action, lease_request_t::ACQUIRE);
  EXPECT_EQ(ToMessage(PilotOutput::Lease::kTakeOver, {}, kNow).action, lease_request_t::TAKE_OVER);
  EXPECT_EQ(ToMessage(PilotOutput::Estop::kStop, kNow).action, estop_t::STOP);
  EXPECT_EQ(ToMessage(PilotOutput::Estop::kRearm, kNow).action, estop_t::REARM);
}

TEST(TeleopMessages, UnknownCodesAreShownAsSuch) {
  drive_status_t message{};
  message.mode = 100;
  message.limit = -3;
  message.driver = 77;
  TerminalView view;
  Describe(message, 7, view);
  EXPECT_EQ(view.doing, "?");
  EXPECT_EQ(view.limit, "?");
  EXPECT_EQ(view.lease, "?");
}

}  // namespace
}  // namespace priamos::teleop
