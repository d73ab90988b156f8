#include <gmock/gmock.h>

#include "robot/robot_app.hpp"
#include "test/robot/support/onboard.hpp"

namespace priamos::robot {
namespace {

using testing::Each;

TEST(RobotOperator, AnOperatorTakesTheLeaseAndDrives) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 2);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::OPERATED);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::TELEOP);
  EXPECT_EQ(robot.last_status.session, 7);
  EXPECT_EQ(robot.last_status.allowed, 1);
  EXPECT_NEAR(robot.last_status.speed_m_s, 0.4, 0.05);
  EXPECT_EQ(robot.last_status.refused, 0);
}

TEST(RobotOperator, CommandsWithoutLeaseAreRefusedCountedAndNamed) {
  Onboard robot;
  robot.Run(0.2);
  robot.Drive(0.4, 1);
  EXPECT_FALSE(robot.last_command);
  EXPECT_NEAR(robot.last_status.refused, 25, 3);  // as of the newest status
  EXPECT_EQ(robot.last_status.refusal, drive_status_t::REFUSED_WITHOUT_LEASE);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::NOBODY);
}

TEST(RobotOperator, ACommandThatWasTooLongOnTheRadioIsRefused) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.SendCommand(0.4, 7, 0.25);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.refusal, drive_status_t::REFUSED_TOO_OLD);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

TEST(RobotOperator, ALeaseRequestThatComesMuchTooLateIsNotGranted) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::TAKE_OVER, 7, lease_request_t::TELEOP, 3);
  robot.SendLease(99);
  robot.SendLease(lease_request_t::ACQUIRE, 7, 55);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::NOBODY);
}

TEST(RobotOperator, ThePlannersPathIsDrivenWithTheLeaseAndEndsWhenItIsTaken) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::PLANNER);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::PLANNER) << "only a take-over takes it";
  robot.SendLease(lease_request_t::TAKE_OVER);
  robot.Run(0.2);
  EXPECT_EQ(robot.last_status.driver, lease_request_t::TELEOP);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_LEASE_LOST);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

TEST(RobotOperator, EstopFromAnybodyStopsAtTheNextTickAndOnlyAFreshRearmLiftsIt) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 1);
  robot.SendEstop(estop_t::STOP, 60);  // however old
  robot.Step();
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  robot.Drive(0.4, 0.5);
  EXPECT_TRUE(robot.last_status.estop);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_ESTOP);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  robot.SendEstop(estop_t::REARM, 3);
  robot.Run(0.2);
  EXPECT_TRUE(robot.last_status.estop) << "an old re-arming";
  robot.SendEstop(estop_t::REARM);
  robot.Drive(0.4, 0.5);
  EXPECT_FALSE(robot.last_status.estop);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0)) << "the stick was not let go";
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 0.5);
  EXPECT_GT(robot.last_command->speed_rad_s[0], 1);
}

TEST(RobotOperator, ARadioThatSaysItIsDownStopsTheOperator) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendLease(lease_request_t::ACQUIRE);
  robot.Drive(0, 0.1);
  robot.Drive(0.4, 1);
  robot.links.Publish(link_status_t{});
  robot.Drive(0.4, 0.4);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_LINK_LOST);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

}  // namespace
}  // namespace priamos::robot
