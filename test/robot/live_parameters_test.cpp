// Every parameter of the robot that may be changed while it runs has its effect at once: a base that was told
// of a value behaves like one that was started with it, and unlike one that was not.

#include "test/support/parameters/live_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "robot/robot_config.hpp"
#include "test/robot/support/robot_rig.hpp"

namespace priamos::robot {
namespace {

const LeaseHolder kHand{Driver::kTeleop, 3};

/// A base whose `drive` section is that of `started`, and is replaced by that of `told` after a tick.
class Base : public RobotRig {
 public:
  Base(const RobotConfig& started, const RobotConfig& told, std::vector<Surface> surfaces = {})
      : RobotRig(1, {0, 0, 0}, started.localiser, started.drive, std::move(surfaces)) {
    Tick();
    drive().Reconfigure(told.drive);
  }
  double Speed() { return std::hypot(base().twist().vx, base().twist().vy); }
  /// An echo of the sensor that looks ahead, and none of the others.
  void HearAhead(double range_m) {
    SonarCycle cycle{now(), {}};
    cycle.range_m.fill(-1);
    cycle.range_m[0] = range_m;
    drive().AddSonar(cycle, localiser().odometry().pose());
  }
  double Nearest() { return state().nearest ? state().nearest->free_m : 9; }
};

/// A wall across the way, its face at x.
std::vector<Surface> WallAt(double x_m) {
  return {{{x_m, -2}, {x_m, 2}}};
}
/// A post's end beside the way, so far from the side of the base.
std::vector<Surface> PostBeside(double gap_m) {
  const double y = DriveConfig().footprint.width_m / 2 + gap_m;
  return BoxSides(0.8, y, 1.0, y + 0.4);
}

using Measure = std::function<double(const RobotConfig& started, const RobotConfig& told)>;

double SpeedOnAPath(const RobotConfig& started, const RobotConfig& told) {
  Base base(started, told);
  base.SetPath({.id = 1, .speed_m_s = 0.5, .points = {{5, 0, 0}}});
  base.Run(3);
  return base.Speed();
}

double TurnOnAPath(const RobotConfig& started, const RobotConfig& told) {
  Base base(started, told);
  base.SetPath({.id = 1, .speed_m_s = 0.5, .points = {{0, 0, 3}}});
  base.Run(3);
  return base.base().twist().wz;
}

Measure AfterHolding(const Twist2& wish, double seconds) {
  return [=](const RobotConfig& started, const RobotConfig& told) {
    Base base(started, told);
    base.TakeOver(kHand);
    base.Hold(kHand, wish, seconds);
    return base.Speed() + std::abs(base.base().twist().wz);
  };
}

Measure PlaceByHand(const std::vector<Surface>& surfaces) {
  return [=](const RobotConfig& started, const RobotConfig& told) {
    Base base(started, told, surfaces);
    base.TakeOver(kHand);
    base.Hold(kHand, {0.3, 0, 0}, 4);
    return base.base().truth().x + 10 * base.base().truth().y;
  };
}

Measure PlaceOnAPath(const std::vector<Surface>& surfaces) {
  return [=](const RobotConfig& started, const RobotConfig& told) {
    Base base(started, told, surfaces);
    base.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{3, 0, 0}}});
    base.Run(5);
    return base.base().truth().x;
  };
}

double OneEchoAhead(const RobotConfig& started, const RobotConfig& told) {
  Base base(started, told);
  base.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{3, 0, 0}}});
  base.Run(1);
  base.HearAhead(0.6);
  base.Tick();
  return base.Nearest();
}

/// What is left of believed echoes when the ring has been silent for 0.24 s.
double EchoesAfterSilence(const RobotConfig& started, const RobotConfig& told) {
  Base base(started, told);
  base.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{3, 0, 0}}});
  base.Run(1);
  base.sonars_answer = false;
  for (int i = 0; i < 3; ++i) base.HearAhead(1.5);
  base.Run(0.24);
  return base.Nearest();
}

double DrivesByAPoorPose(const RobotConfig& started, const RobotConfig& told) {
  Base base(started, told);
  base.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{3, 0, 0}}});
  base.Run(3);
  return base.Speed();
}

double ModeBeforeAWall(const RobotConfig& started, const RobotConfig& told) {
  Base base(started, told, WallAt(1.1));
  base.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{3, 0, 0}}});
  base.Run(6);
  return static_cast<double>(base.state().mode);
}

struct Story {
  double value;  ///< another one than the default
  Measure measure;
};

const std::map<std::string, Story> kStories{
    {"drive.follower.shape.max_speed_m_s", {0.2, SpeedOnAPath}},
    {"drive.follower.shape.max_turn_rad_s", {0.2, TurnOnAPath}},
    {"drive.operator_acceleration.acceleration_m_s2", {0.2, AfterHolding({0.6, 0, 0}, 0.5)}},
    {"drive.operator_acceleration.turn_acceleration_rad_s2", {0.2, AfterHolding({0, 0, 0.6}, 0.3)}},
    {"drive.operator_margin_m", {0.3, PlaceByHand(PostBeside(0.12))}},
    {"drive.collision.margin_m", {0.2, PlaceOnAPath(PostBeside(0.1))}},
    {"drive.collision.gap_m", {0.5, PlaceOnAPath(WallAt(1.2))}},
    {"drive.echoes.near_m", {1, OneEchoAhead}},
    {"drive.echoes.keep_s", {1, EchoesAfterSilence}},
    {"drive.lost_position_m", {0.1, DrivesByAPoorPose}},
    {"drive.lost_yaw_deg", {2, DrivesByAPoorPose}},
    {"drive.blocked_s", {60, ModeBeforeAWall}},
};

TEST(LiveParametersOfTheRobot, EachHasItsStory) {
  ExpectAStoryForEach<RobotConfig>(kStories);
}

class LiveParameterTest : public testing::TestWithParam<std::string> {};

TEST_P(LiveParameterTest, IsObeyedAtOnceAsIfTheRobotHadBeenStartedWithIt) {
  const Story& story = kStories.at(GetParam());
  ExpectObeyedAtOnce<RobotConfig>(GetParam(), story.value, story.measure);
}

INSTANTIATE_TEST_SUITE_P(OfTheRobot, LiveParameterTest, testing::ValuesIn(NamesOf(kStories)),
                         ParameterTestName);

TEST(LiveParametersOfTheRobot, ABaseInMotionSlowsDownOnItsPathAndSpeedsUpAgain) {
  const RobotConfig standard;
  RobotConfig slow;
  slow.drive.follower.shape.max_speed_m_s = 0.2;
  Base base(standard, standard);
  base.SetPath({.id = 1, .speed_m_s = 0.5, .points = {{5, 0, 0}}});
  base.Run(3);
  EXPECT_NEAR(base.Speed(), 0.5, 0.03);
  base.drive().Reconfigure(slow.drive);
  base.Run(2);
  EXPECT_NEAR(base.Speed(), 0.2, 0.02);
  base.drive().Reconfigure(standard.drive);
  base.Run(2);
  EXPECT_NEAR(base.Speed(), 0.5, 0.03);
}

}  // namespace
}  // namespace priamos::robot
