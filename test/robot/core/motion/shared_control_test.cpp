// Stories of an operator, a planner, and what goes wrong between them.

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "common/random.hpp"
#include "test/robot/support/robot_rig.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::Each;

const LeaseHolder kTeleop{Driver::kTeleop, 3}, kConsole{Driver::kConsole, 4};
const Twist2 kForward{0.6, 0, 0};

class SharedControlTest : public testing::Test {
 protected:
  double Speed() { return std::hypot(rig_.base().twist().vx, rig_.base().twist().vy); }
  bool WheelsAreZero() {
    return rig_.command() && std::all_of(rig_.command()->begin(), rig_.command()->end(),
                                         [](double speed) { return speed == 0; });
  }
  /// Ticks until the wheel command is 0, at most 2 s.
  milliseconds TimeToZero() {
    milliseconds time{};
    while (!WheelsAreZero() && time < milliseconds(2000)) {
      rig_.Tick();
      time += milliseconds(20);
    }
    return time;
  }
  void ExpectNoMotionFor(double seconds) {
    for (int i = 0; i < seconds * 50; ++i) {
      rig_.Tick();
      ASSERT_TRUE(WheelsAreZero());
    }
  }

  RobotRig rig_{1, {0, 0, 0}};
};

TEST_F(SharedControlTest, AnOperatorTakesTheLeaseAndDrives) {
  rig_.Run(0.2);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 2);
  EXPECT_EQ(rig_.state().mode, DriveMode::kOperated);
  EXPECT_EQ(rig_.state().holder, kTeleop);
  EXPECT_NEAR(Speed(), 0.6, 0.03);
  EXPECT_EQ(rig_.state().allowed, 1);
}

TEST_F(SharedControlTest, WithoutTheLeaseNothingMoves) {
  rig_.Run(0.2);
  rig_.Hold(kTeleop, kForward, 1);
  EXPECT_FALSE(rig_.command());
  EXPECT_GT(rig_.state().refused_commands, 10);
}

TEST_F(SharedControlTest, TheStickIsLetGo) {
  rig_.Run(0.2);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 2);
  rig_.Command(kTeleop, {});
  EXPECT_LE(TimeToZero(), milliseconds(20));
  ExpectNoMotionFor(1);
  EXPECT_EQ(rig_.state().mode, DriveMode::kHolding);
  EXPECT_FALSE(rig_.state().halted_by) << "a normal end";
}

TEST_F(SharedControlTest, TheStickIsLetGoWhileAHoldBrakes) {
  rig_.Run(0.2);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 2);
  rig_.wheels_answer = false;
  rig_.Hold(kTeleop, kForward, 0.3);
  ASSERT_EQ(rig_.state().failsafe.cause, Condition::kWheelsSilent);
  ASSERT_FALSE(WheelsAreZero()) << "on a ramp";
  rig_.Command(kTeleop, {});
  EXPECT_LE(TimeToZero(), milliseconds(20));
  rig_.wheels_answer = true;
  ExpectNoMotionFor(1);
}

TEST_F(SharedControlTest, TheOperatorsProgramDies) {
  rig_.Run(0.2);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 2);
  EXPECT_LE(TimeToZero(), milliseconds(260));
  ExpectNoMotionFor(1);
  EXPECT_EQ(rig_.state().halted_by, Condition::kOperatorSilent);
  rig_.Run(4);
  EXPECT_EQ(rig_.state().holder.driver, Driver::kNobody) << "the lease is free again";
}

TEST_F(SharedControlTest, EstopIsPressedAtFullSpeedAndRearmed) {
  rig_.Run(0.2);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 2);
  rig_.drive().PressEstop();
  rig_.Tick();
  EXPECT_TRUE(WheelsAreZero());
  EXPECT_EQ(rig_.state().failsafe.cause, Condition::kEstop);
  rig_.Hold(kTeleop, kForward, 1);
  EXPECT_TRUE(WheelsAreZero()) << "latched";
  rig_.drive().Rearm();
  rig_.Hold(kTeleop, kForward, 1);
  EXPECT_TRUE(WheelsAreZero()) << "the stick was never let go";
  rig_.Hold(kTeleop, {}, 0.1);
  rig_.Hold(kTeleop, kForward, 1);
  EXPECT_GT(Speed(), 0.3);
}

TEST_F(SharedControlTest, EstopEndsAPathForGood) {
  rig_.Run(0.2);
  const Path path{.id = 1, .speed_m_s = 0.4, .points = {{5, 0, 0}}};
  rig_.SetPath(path);
  rig_.Run(2);
  rig_.drive().PressEstop();
  rig_.Tick();
  EXPECT_TRUE(WheelsAreZero());
  EXPECT_EQ(rig_.SetPath(path), PathVerdict::kEstop);
  rig_.drive().Rearm();
  ExpectNoMotionFor(1);
  EXPECT_EQ(rig_.state().halted_by, Condition::kEstop);
  EXPECT_EQ(rig_.SetPath(path), PathVerdict::kStale) << "repeated by a planner that missed the stop";
  EXPECT_EQ(rig_.SetPath({.id = 2, .speed_m_s = 0.4, .points = {{5, 1, 0}}}), PathVerdict::kStale)
      << "the next path of a mission that missed the stop";
  ExpectNoMotionFor(1);
  const int changes = rig_.state().estop_changes;
  EXPECT_EQ(rig_.SetPath({.id = 3, .speed_m_s = 0.4, .points = {{5, 0, 0}}, .estop_changes = changes}),
            PathVerdict::kTaken);
  rig_.Run(2);
  EXPECT_GT(Speed(), 0.3);
}

/// A planner repeats its path until it is confirmed, also while the e-stop is latched.
TEST_F(SharedControlTest, APathOrderedDuringAnEstopIsNotDrivenAfterIt) {
  rig_.Run(0.2);
  rig_.drive().PressEstop();
  rig_.Tick();
  const Path path{
      .id = 1, .speed_m_s = 0.4, .points = {{5, 0, 0}}, .estop_changes = rig_.state().estop_changes};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(rig_.SetPath(path), PathVerdict::kEstop);
    rig_.Run(0.5);
  }
  EXPECT_EQ(rig_.SetPath({.id = 2}), PathVerdict::kEstop) << "an order to brake changes nothing";
  rig_.drive().Rearm();
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(rig_.SetPath(path), PathVerdict::kStale);
    rig_.Run(0.5);
    EXPECT_FALSE(rig_.command()) << "nothing was ordered";
  }
}

TEST_F(SharedControlTest, TeleopTakesOverFromAPath) {
  rig_.Run(0.2);
  rig_.SetPath({.id = 1, .speed_m_s = 0.4, .points = {{5, 0, 0}}});
  rig_.Run(2);
  EXPECT_EQ(rig_.drive().RequestLease(kTeleop, Lease::Wish::kAcquire, rig_.now()), Lease::Answer::kRefused);
  rig_.Run(0.2);
  EXPECT_GT(Speed(), 0.3) << "asking politely does not stop the path";
  rig_.drive().RequestLease(kTeleop, Lease::Wish::kTakeOver, rig_.now());
  rig_.Tick();
  EXPECT_TRUE(WheelsAreZero());
  EXPECT_EQ(rig_.state().halted_by, Condition::kLeaseLost);
  EXPECT_EQ(rig_.SetPath({.id = 2, .speed_m_s = 0.4, .points = {{5, 0, 0}}}), PathVerdict::kWithoutLease);
  rig_.Hold(kTeleop, {}, 0.1);
  rig_.Hold(kTeleop, {-0.3, 0, 0}, 1.5);
  EXPECT_LT(rig_.base().twist().vx, -0.2);
}

TEST_F(SharedControlTest, AnOperatorDrivesOnAfterAPathHasArrived) {
  rig_.Run(0.2);
  rig_.SetPath({.id = 1, .speed_m_s = 0.4, .points = {{0.5, 0, 0}}});
  rig_.Run(6);
  ASSERT_EQ(rig_.state().mode, DriveMode::kArrived);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 1);
  EXPECT_GT(Speed(), 0.4);
}

TEST_F(SharedControlTest, APathThatStillWaitsIsForgottenWhenAnOperatorTakesOver) {
  rig_.wheels_answer = false;
  rig_.SetPath({.id = 1, .speed_m_s = 0.4, .points = {{5, 0, 0}}});
  rig_.Run(0.5);
  rig_.TakeOver(kTeleop);
  rig_.wheels_answer = true;
  rig_.Run(0.2);
  ExpectNoMotionFor(2);
}

TEST_F(SharedControlTest, TheRadioFailsWhileAnOperatorDrives) {
  rig_.Run(0.2);
  rig_.TakeOver(kTeleop);
  rig_.Hold(kTeleop, kForward, 2);
  rig_.link_down = milliseconds(1);
  EXPECT_LE(TimeToZero(), milliseconds(300));
  ExpectNoMotionFor(1);
}

TEST_F(SharedControlTest, TheRadioFailsWhileAPathIsDriven) {
  rig_.Run(0.2);
  rig_.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}});
  rig_.Run(3);
  rig_.link_down = milliseconds(1);
  rig_.Run(9);
  EXPECT_GT(Speed(), 0.25);
  rig_.Run(2);
  EXPECT_LT(Speed(), 1e-3);
  EXPECT_EQ(rig_.state().failsafe.cause, Condition::kLinkLost);
  rig_.link_down = {};
  rig_.Run(3);
  EXPECT_GT(Speed(), 0.25) << "goes on";
}

TEST_F(SharedControlTest, TheHeadFallsSilentButThePoseIsGood) {
  rig_.Run(0.2);
  rig_.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}});
  rig_.head_answers = false;
  rig_.Run(8);
  EXPECT_GT(Speed(), 0.25);
}

TEST(SharedControl, TheHeadFallsSilentWhileAFixIsNeeded) {
  LocaliserConfig vague;
  vague.estimator.initial.position_error_m = 0.6;
  RobotRig rig(1, {0, 0, 0}, vague);
  rig.Run(0.2);
  rig.SetPath({.id = 1, .speed_m_s = 0.3, .points = {{8, 0, 0}}});
  rig.Run(2);
  EXPECT_GT(rig.base().twist().vx, 0.25);
  rig.head_answers = false;
  rig.Run(4);
  EXPECT_EQ(rig.state().failsafe.cause, Condition::kHeadSilent);
  EXPECT_LT(rig.base().twist().vx, 1e-3);
}

TEST(SharedControl, TheOperatorCannotPushTheBaseIntoAWall) {
  RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(-1.5, -1.5, 1.5, 1.5));
  rig.Run(0.3);
  rig.TakeOver(kTeleop);
  for (const Twist2& push : {Twist2{0.6, 0, 0}, Twist2{0, 0.6, 0}, Twist2{-0.6, 0, 0}, Twist2{0, -0.6, 0}}) {
    rig.Hold(kTeleop, push, 5);
    EXPECT_LT(rig.state().allowed, 0.5);
  }
  EXPECT_GT(rig.min_gap(), 0.02);
}

TEST(SharedControl, PushedAtASlantItSlidesAlongTheWall) {
  RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(1.2, -4, 1.5, 4));
  rig.Run(0.3);
  rig.TakeOver(kTeleop);
  rig.Hold(kTeleop, {0.3, 0.3, 0}, 6);
  EXPECT_GT(rig.base().truth().y, 1.0);
  EXPECT_GT(rig.min_gap(), 0.02);
}

/// A box ahead with room beside it: whoever pushes past it gets past it, however he holds the stick.
TEST(SharedControl, PushedAtASlantItGetsPastABox) {
  for (const double slant_deg : {12.0, 20.0, 35.0, 50.0, 65.0})
    for (const double y : {-0.6, -0.3, 0.0, 0.2}) {
      RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(1.3, y - 0.2, 1.7, y + 0.2));
      rig.Run(0.3);
      rig.TakeOver(kTeleop);
      rig.Hold(kTeleop, {0.4 * std::cos(Radians(slant_deg)), 0.4 * std::sin(Radians(slant_deg)), 0}, 20);
      EXPECT_GT(rig.base().truth().x, 1.3) << slant_deg << " degrees, box at " << y;
      EXPECT_GT(rig.min_gap(), 0.02) << slant_deg << " degrees, box at " << y;
    }
}

SonarCycle AnyCycle() {
  SonarCycle cycle;
  for (double& range_m : cycle.range_m)
    range_m = *rc::gen::inRange(0, 8) == 0 ? *rc::gen::inRange(10, 80) / 100.0 : -1;
  return cycle;
}

/// Whatever the sonars hear and the operator wishes: a base at rest sets off wherever a part of the wish is
/// free.
TEST(SharedControl, WhatIsFreeOfAWishMoves) {
  EXPECT_TRUE(rc::check([] {
    const auto part = [] { return *rc::gen::inRange(-500, 501) / 1000.0; };
    const Twist2 wish{part(), part(), part()};
    SonarCycle cycle = AnyCycle();
    RobotRig rig(1, {0, 0, 0});
    EchoMemory echoes{EchoMemoryConfig{}, Footprint{}};
    rig.sonars_answer = rig.wheels_turn = false;
    rig.Run(0.1);
    rig.TakeOver(kTeleop);
    for (int i = 0; i < 3; ++i) {
      cycle.time = rig.now();
      rig.drive().AddSonar(cycle, {});
      echoes.Add(cycle, {});
      rig.Hold(kTeleop, wish, 0.1);
    }
    CollisionStopConfig config;
    config.margin_m += DriveConfig().operator_margin_m;
    config.memory_margin_m += DriveConfig().operator_margin_m;
    const CollisionStop guard(config, Footprint{});
    auto seen = echoes.Points({});
    const auto bridges = echoes.Bridges({});
    seen.insert(seen.end(), bridges.begin(), bridges.end());
    const auto speed = [](const Twist2& t) { return std::hypot(t.vx, t.vy, t.wz * Footprint().Reach()); };
    const Twist2 free = Deflected(wish, Footprint().Reach(), [&](const Twist2& motion) {
      return guard.Scale(motion, seen, echoes.Remembered({}));
    });
    RC_PRE(speed(free) > 0.15 * speed(wish) && speed(wish) > 0.1);
    RC_ASSERT(std::any_of(rig.command()->begin(), rig.command()->end(), [](double w) { return w != 0; }));
  }));
}

/// The acceleration limits make the first step of a turn larger than that of a drive. Beside a corner that
/// forbids the turn the base must drive off all the same.
TEST(SharedControl, ATurnThatIsNotFreeDoesNotHoldTheDriveThatIs) {
  RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(-0.9, -0.9, -0.46, -0.46));
  rig.Run(0.3);
  rig.TakeOver(kTeleop);
  rig.Hold(kTeleop, {0.25, -0.3, 0.1}, 5);
  EXPECT_GT(rig.base().truth().x, 0.6);
  EXPECT_GT(rig.min_gap(), 0.02);
}

/// A post that no beam hears any more is known from before: it is passed like one that is seen.
TEST(SharedControl, PushedAtASlantItGetsPastAPostThatItRemembers) {
  for (const double y : {-0.35, -0.2, 0.1, 0.25}) {
    RobotRig rig(1, {0, 0, 0}, {}, {}, BoxSides(1.2, y - 0.02, 1.24, y + 0.02));
    rig.Run(0.3);
    rig.TakeOver(kTeleop);
    rig.Hold(kTeleop, {0.3, 0.1, 0}, 20);
    EXPECT_GT(rig.base().truth().x, 1.3) << y;
    EXPECT_GT(rig.min_gap(), 0) << y;
  }
}

/// A monkey at the stick: holds a random wish for a random while, in a room with furniture.
TEST(SharedControl, AMonkeyTouchesNothingAndIsMostlyObeyed) {
  int obeyed = 0, asked = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::vector<Surface> room = BoxSides(-3, -3, 3, 3);
    for (const auto& box : {BoxSides(1.2, 1.0, 1.8, 1.6), BoxSides(-2.0, -1.8, -1.5, -1.2)})
      room.insert(room.end(), box.begin(), box.end());
    RobotRig rig(seed, {0, 0, 0}, {}, {}, room);
    Rng rng = Rng::Stream(seed, "monkey");
    rig.Run(0.3);
    rig.TakeOver(kTeleop);
    for (int hold = 0; hold < 40; ++hold) {
      const Twist2 wish{rng.Uniform(-0.5, 0.5), rng.Uniform(-0.5, 0.5), rng.Uniform(-0.6, 0.6)};
      const double seconds = rng.Uniform(0.2, 2.5);
      for (int tick = 0; tick < seconds * 50; ++tick) {
        if (tick % 2 == 0) rig.Command(kTeleop, wish);
        rig.Tick();
        ++asked;
        obeyed += rig.state().mode == DriveMode::kOperated;
      }
    }
    EXPECT_GT(rig.min_gap(), 0) << seed;
  }
  EXPECT_GT(obeyed, 0.9 * asked);
}

}  // namespace
}  // namespace priamos::robot
