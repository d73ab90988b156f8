#include <gmock/gmock.h>

#include <filesystem>
#include <memory>

#include "robot/robot_app.hpp"
#include "test/robot/support/onboard.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::robot {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A robot, and the one that is started after it.
class RestartTest : public testing::Test {
 protected:
  RestartTest() { config_.state_file = (folder_ / "robot-state").string(); }
  /// Ends the robot so that the file is left as by kill -9 or a loss of power.
  void Crash(std::unique_ptr<Onboard> robot) {
    std::filesystem::copy_file(config_.state_file, folder_ / "kept");
    robot.reset();
    std::filesystem::rename(folder_ / "kept", config_.state_file);
  }
  std::unique_ptr<Onboard> Started() {
    auto robot = std::make_unique<Onboard>(config_);
    robot->Run(0.3);
    return robot;
  }
  /// Whether an operator can drive it.
  static bool Drives(Onboard& robot) {
    robot.SendLease(lease_request_t::ACQUIRE);
    robot.Drive(0, 0.1);
    robot.Drive(0.3, 0.5);
    return robot.last_command && robot.last_command->speed_rad_s[0] > 1;
  }

  TemporaryFolder folder_;
  RobotConfig config_;
};

TEST_F(RestartTest, AfterAnOrderlyEndItDrives) {
  EXPECT_TRUE(Drives(*Started()));
  EXPECT_TRUE(Drives(*Started()));
}

TEST_F(RestartTest, ALatchedEstopOutlivesAnOrderlyEnd) {
  auto robot = Started();
  robot->SendEstop(estop_t::STOP);
  robot->Run(0.1);
  robot.reset();
  robot = Started();
  EXPECT_TRUE(robot->last_status.estop);
  EXPECT_FALSE(Drives(*robot));
}

TEST_F(RestartTest, ALatchedEstopOutlivesACrash) {
  auto robot = Started();
  robot->SendEstop(estop_t::STOP);
  robot->Run(0.02);
  Crash(std::move(robot));
  EXPECT_TRUE(Started()->last_status.estop);
}

TEST_F(RestartTest, AfterACrashNeitherOperatorNorPathMovesItBeforeSomebodyReArms) {
  auto robot = Started();
  ASSERT_TRUE(Drives(*robot));
  Crash(std::move(robot));
  robot = Started();
  EXPECT_TRUE(robot->last_status.estop);
  EXPECT_THAT(robot->log, Contains(HasSubstr("did not end in order")));
  EXPECT_FALSE(Drives(*robot));
  robot->SendPath(1, 2);
  robot->Run(0.5);
  EXPECT_FALSE(robot->last_command) << "the planner repeats its path by itself";
  robot->SendEstop(estop_t::REARM);
  robot->Run(0.1);
  EXPECT_TRUE(Drives(*robot));
}

TEST_F(RestartTest, AfterACrashThePoseIsUnknownAndAfterAnOrderlyEndItIsNot) {
  auto robot = Started();
  robot.reset();
  robot = Started();
  ASSERT_TRUE(robot->pose.get());
  EXPECT_LT(robot->pose.get()->sigma_x_m, 0.2);
  Crash(std::move(robot));
  robot = Started();
  ASSERT_TRUE(robot->pose.get());
  EXPECT_GT(robot->pose.get()->sigma_x_m, 0.5) << "where a planner takes it for lost";
  EXPECT_THAT(robot->log, Contains(HasSubstr("priamos place")));
}

TEST_F(RestartTest, ARearmingThatCannotBeWrittenDownIsNone) {
  auto robot = Started();
  robot->SendEstop(estop_t::STOP);
  robot->Run(0.1);
  std::filesystem::create_directory(config_.state_file + ".new");
  robot->SendEstop(estop_t::REARM);
  robot->Run(0.1);
  EXPECT_TRUE(robot->last_status.estop);
  std::filesystem::remove(config_.state_file + ".new");
  robot->SendEstop(estop_t::REARM);
  robot->Run(0.1);
  EXPECT_FALSE(robot->last_status.estop);
}

}  // namespace
}  // namespace priamos::robot
