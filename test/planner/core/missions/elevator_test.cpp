#include <gmock/gmock.h>

#include "door_mission_story.hpp"

// The door mission into the cabin of an elevator and out of it.

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

struct Elevator : DoorStory {
  explicit Elevator(const Pose2& truth = {2.0, 2.4, 0}) : DoorStory(truth, ElevatorPlan()) {}
  void Ride() {
    Start();
    robot.RunFor(90);
  }
};

TEST(ElevatorMission, InAndOutBackwards) {
  Elevator s;
  s.Ride();
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_NEAR(s.robot.truth().x, 6.77, 0.02);
  const std::size_t looks = s.robot.looks.size();
  s.Ride();
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_NEAR(s.robot.truth().x, 4.5, 0.02);
  EXPECT_NEAR(s.robot.truth().yaw, 0, 0.02) << "backwards";
  EXPECT_EQ(s.robot.looks.size(), looks) << "it is too near to look";
}

TEST(ElevatorMission, WhoDidNotComeInThroughTheDoorIsNotLedOut) {
  Elevator s({6.77, 2.4, 0});
  s.robot.sigma_m = 0.005;
  s.Ride();
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("it did not come in through door 'cabin'"));
  EXPECT_THAT(s.dut.state().text, HasSubstr("next: "));
  EXPECT_TRUE(s.robot.paths.empty() || s.robot.paths.back().points.empty());
}

TEST(ElevatorMission, APoseThatHasBecomeUncertainInItIsNotDrivenBy) {
  Elevator s;
  s.Ride();
  s.robot.sigma_m = 0.05;
  for (int i = 0; i < 40; ++i) s.robot.Step();
  s.Ride();
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("the pose is too uncertain for the gap"));
  EXPECT_NEAR(s.robot.truth().x, 6.77, 0.02);
}

TEST(ElevatorMission, BeforeAClosedDoorItStaysInTheCabin) {
  Elevator s;
  s.Ride();
  s.Start();
  s.robot.RunUntil(Phase::kPassing, 5);
  s.robot.RunFor(1);
  s.robot.blocked = true;
  s.robot.RunUntil(Phase::kRetreating, 20);
  s.robot.blocked = false;
  for (int i = 0; i < 20; ++i) s.robot.Step();  // the radio
  EXPECT_EQ(s.dut.state().phase, Phase::kRetreating) << s.dut.state().text;
  ASSERT_FALSE(s.robot.paths.back().points.empty());
  EXPECT_NEAR(s.robot.paths.back().points.back().x, 6.77, 0.02);
  s.robot.RunFor(90);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << "it opened: " << s.dut.state().text;
  EXPECT_NEAR(s.robot.truth().x, 4.5, 0.02);
}

}  // namespace
}  // namespace priamos::planner
