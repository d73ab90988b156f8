#include "robot/robot_app.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "test/robot/support/onboard.hpp"

namespace priamos::robot {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;

TEST(RobotApp, SaysWhereItIsBeforeItIsToldToMove) {
  Onboard robot;
  robot.Run(0.5);
  ASSERT_TRUE(robot.pose.get());
  ASSERT_TRUE(robot.odometry.get());
  EXPECT_FALSE(robot.last_command);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::IDLE);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_NONE);
}

TEST(RobotApp, ReportsItsStatusTenTimesPerSecond) {
  Onboard robot;
  robot.Run(5);
  EXPECT_NEAR(robot.statuses, 50, 1);
}

TEST(RobotApp, DrivesAPathAndReportsIt) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(3);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::FOLLOWING);
  EXPECT_EQ(robot.last_status.path_id, 4);
  EXPECT_NEAR(robot.last_status.speed_m_s, 0.4, 0.05);
  robot.Run(10);
  EXPECT_EQ(robot.last_status.mode, drive_status_t::ARRIVED);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
}

TEST(RobotApp, APersonSetsItsPoseWhileItStands) {
  Onboard robot;
  robot.Run(0.5);
  EXPECT_EQ(robot.VerdictOnPose(), pose_correction_t::RESET);
  robot.Run(0.1);
  EXPECT_NEAR(robot.pose.get()->x_m, 4, 0.01);
  EXPECT_NEAR(robot.pose.get()->yaw_rad, 1, 0.01);
  EXPECT_NEAR(robot.pose.get()->sigma_x_m, 0.1, 0.01);
  EXPECT_THAT(robot.log, Contains(HasSubstr("pose 9 set by order: (4.00, 1.00), 57 deg")));
}

TEST(RobotApp, AfterAPathItsNewPoseDoesNotLeadItBack) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 1);
  robot.Run(8);
  ASSERT_EQ(robot.last_status.mode, drive_status_t::ARRIVED);
  EXPECT_EQ(robot.VerdictOnPose(), pose_correction_t::RESET);
  robot.Run(2);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  EXPECT_NEAR(robot.pose.get()->x_m, 4, 0.02);
}

TEST(RobotApp, APoseIsNotSetWhileItDrivesNorTooLateNorOutsideTheMap) {
  Onboard robot;
  robot.Run(0.5);
  EXPECT_EQ(robot.VerdictOnPose(4, 11), pose_correction_t::TOO_OLD);
  EXPECT_EQ(robot.VerdictOnPose(101), pose_correction_t::IMPLAUSIBLE);
  EXPECT_EQ(robot.VerdictOnPose(std::nan("")), pose_correction_t::IMPLAUSIBLE);
  robot.SendPath(4, 3);
  robot.Run(1);
  EXPECT_EQ(robot.VerdictOnPose(), pose_correction_t::MOVING);
  EXPECT_LT(robot.pose.get()->x_m, 1);
}

TEST(RobotApp, YieldingItCommandsItsWheelsToStandAndNobodyElses) {
  Onboard robot;
  robot.Run(0.2);
  robot.dut.Yield(robot.clock.Now());
  robot.bus.Drain();
  EXPECT_FALSE(robot.command.Take()) << "it has never commanded them";
  robot.SendPath(4, 3);
  robot.Run(1);
  EXPECT_NE(robot.last_command->speed_rad_s[0], 0);
  EXPECT_EQ(robot.last_command->instance, 77);
  robot.dut.Yield(robot.clock.Now());
  robot.bus.Drain();
  const auto last = robot.command.Take();
  ASSERT_TRUE(last);
  EXPECT_THAT(last->speed_rad_s, Each(0.0));
  EXPECT_EQ(last->instance, 77);
}

TEST(RobotApp, SaysThatTheBoardHoldsTheWheelsBecauseOfAnother) {
  Onboard robot;
  robot.Run(0.2);
  wheel_state_t message{};
  message.utime = ToUtime(robot.clock.Now());
  message.contested = 1;
  message.foreign_commands = 3;
  robot.wheels.Publish(message);
  robot.Step();
  EXPECT_THAT(robot.log, Contains(HasSubstr("another process commands them, too; 3 of its commands")));
  robot.Run(0.1);
  EXPECT_THAT(robot.log, Contains(HasSubstr("by one process again")));
}

TEST(RobotApp, ATouchHaltsItWidensItsPoseAndIsReported) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(2);
  const double sigma_m = robot.pose.get()->sigma_x_m;
  bumper_t message{};
  message.utime = ToUtime(robot.clock.Now());
  message.pressed = bumper_t::FRONT_LEFT;
  robot.bumper.Publish(message);
  robot.Run(0.3);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_TOUCHED);
  EXPECT_THAT(robot.log, Contains(HasSubstr("touched something at the front's left half")));
  // It may have slipped by 0.02 m + 0.25 s * 0.4 m/s.
  EXPECT_GT(robot.pose.get()->sigma_x_m, std::hypot(sigma_m, 0.1));
}

TEST(RobotApp, CurrentsThatAreNoNumbersAreNoTouch) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  for (int i = 0; i < 50; ++i) {
    motor_current_t message{};
    message.utime = ToUtime(robot.clock.Now());
    for (double& current : message.current_a) current = std::nan("");
    robot.currents.Publish(message);
    robot.Step();
  }
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_NONE);
}

TEST(RobotApp, RepeatsTheOpeningItDroveThrough) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(1);
  robot.beside_m = 0.12;
  robot.Run(2);
  robot.beside_m = -1;
  EXPECT_TRUE(robot.openings.Drain().empty());
  robot.Run(4);
  const auto openings = robot.openings.Drain();
  EXPECT_NEAR(double(openings.size()), 4, 1);
  ASSERT_FALSE(openings.empty());
  EXPECT_NEAR(openings[0].width_m, 0.78 + 0.24, 1e-6);
  EXPECT_EQ(openings[0].utime, openings.back().utime) << "of the same opening";
}

TEST(RobotApp, AnswersAFixAndMovesItsPose) {
  Onboard robot;
  robot.Run(0.5);
  robot.fixes.Publish(robot.Fix(11));
  robot.Run(0.1);
  const auto answers = robot.corrections.Drain();
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].verdict, pose_correction_t::APPLIED);
  EXPECT_EQ(answers[0].request_id, 11);
  EXPECT_NEAR(answers[0].dy_m, 0.1, 0.01);
  EXPECT_NEAR(robot.pose.get()->y_m, 0.1, 0.01);
}

TEST(RobotApp, AnswersAFixThatTheHeadCouldNotGive) {
  Onboard robot;
  robot.Run(0.5);
  landmark_fix_t fix = robot.Fix(12);
  fix.verdict = landmark_fix_t::NOT_VISIBLE;
  robot.fixes.Publish(fix);
  robot.Run(0.1);
  EXPECT_EQ(robot.corrections.Drain().at(0).verdict, pose_correction_t::NOT_FOUND);
}

TEST(RobotApp, AnswersARepeatedFixOnce) {
  Onboard robot;
  robot.Run(0.5);
  const landmark_fix_t fix = robot.Fix(13);
  robot.fixes.Publish(fix);
  robot.fixes.Publish(fix);
  robot.Run(0.1);
  EXPECT_EQ(robot.corrections.Drain().size(), 1u);
}

TEST(RobotApp, StopsAndSaysWhyWhenTheWheelsFallSilent) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, 3);
  robot.Run(3);
  robot.wheels_answer = false;
  robot.Run(1);
  EXPECT_EQ(robot.last_status.limit, drive_status_t::LIMIT_WHEELS_SILENT);
  EXPECT_THAT(robot.last_command->speed_rad_s, Each(0.0));
  EXPECT_EQ(robot.context.health(), bus::Health::kDegraded);
  EXPECT_THAT(robot.log, Contains(HasSubstr("no credible encoder sample")));
  robot.wheels_answer = true;
  robot.Run(1);
  EXPECT_EQ(robot.context.health(), bus::Health::kOk);
}

TEST(RobotApp, RefusesAPathThatCannotBeDriven) {
  Onboard robot;
  robot.Run(0.2);
  robot.SendPath(4, std::nan(""));
  robot.Run(0.2);
  EXPECT_FALSE(robot.last_command);
  EXPECT_THAT(robot.log, Contains(HasSubstr("path 4 refused")));
}

TEST(RobotApp, WallsAreToldUntilTheyAreAcknowledged) {
  Onboard robot;
  robot.Run(0.2);
  robot.beside_m = 1.0;
  robot.SendPath(1, 2.5);
  robot.Run(8);
  const auto told = robot.features.Drain();
  ASSERT_GE(told.size(), 1u);
  ASSERT_GE(told.back().n_features, 1);
  const feature_t& wall = told.back().features[0];
  EXPECT_EQ(wall.kind, feature_t::WALL);
  EXPECT_GT(wall.length_m, 0.6);
  EXPECT_NEAR(std::abs(wall.y_m), 1.39, 0.4) << "the start is known to 20 cm";
  EXPECT_GT(wall.sigma_across_m, 0.05) << "and so is the wall";
  robot.Run(40);
  const auto again = robot.features.Drain();
  ASSERT_GE(again.size(), 2u) << "nobody has acknowledged it";
  features_ack_t ack{};
  ack.store = again.back().store;
  for (const features_t& batch : again) {
    ack.batch = batch.batch;
    robot.feature_acks.Publish(ack);
  }
  robot.Run(15);
  for (const features_t& batch : robot.features.Drain()) {
    ack.batch = batch.batch;
    robot.feature_acks.Publish(ack);
  }
  robot.Run(15);
  EXPECT_THAT(robot.features.Drain(), testing::IsEmpty());
}

TEST(RobotApp, APathThatIsOldIsRefused) {
  Onboard robot;
  robot.Run(0.2);
  path_t path{};
  path.utime = ToUtime(robot.clock.Now() - FromSeconds(11));
  path.path_id = 4;
  path.speed_m_s = 0.4;
  path.points.resize(1);
  path.n_points = 1;
  robot.paths.Publish(path);
  robot.Run(0.2);
  EXPECT_FALSE(robot.last_command);
  EXPECT_THAT(robot.log, Contains(HasSubstr("path 4 refused: too old")));
}

}  // namespace
}  // namespace priamos::robot
