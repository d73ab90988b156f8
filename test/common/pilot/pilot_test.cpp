// Stories of an operator: what he does with stick and buttons, and what the robot is told.

#include "common/pilot/pilot.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos {
namespace {

using std::chrono::milliseconds;

class PilotTest : public testing::Test {
 protected:
  struct Sent {
    Time at;
    Twist2 twist;
  };

  void Tick() {
    now_ += milliseconds(10);
    if (talks_) stick_.heard = now_;
    if (answers_) robot_.heard = now_;
    const PilotOutput output = dut_.Step(stick_, robot_, now_);
    if (output.drive) sent_.push_back({now_, *output.drive});
    if (output.head) head_.push_back(*output.head);
    if (output.lease) leases_.push_back(*output.lease);
    if (output.estop) estops_.push_back(*output.estop);
  }
  void Run(double seconds) {
    for (int i = 0; i < seconds * 100; ++i) Tick();
  }
  void Hold(int button) { stick_.buttons |= 1u << button; }
  void LetGo(int button) { stick_.buttons &= ~(1u << button); }
  void Push(double forward) { stick_.axis[0] = forward; }
  void Click(int button) {
    Hold(button);
    Run(0.05);
    LetGo(button);
    Run(0.05);
  }
  /// The lease is ours and the stick is pushed.
  void DriveOff() {
    Run(0.1);
    Hold(config_.buttons.dead_man);
    Run(0.1);
    robot_.lease = RobotView::Lease::kMine;
    Push(1);
    Run(0.5);
    ASSERT_EQ(dut_.phase(), PilotPhase::kDriving);
    ASSERT_GT(sent_.back().twist.vx, 0);
    sent_.clear();
  }
  int Moving() const {
    return static_cast<int>(
        std::count_if(sent_.begin(), sent_.end(), [](const Sent& s) { return s.twist.vx != 0; }));
  }
  /// Exactly three explicit zeros, the first at once, then nothing.
  void ExpectThreeZerosThenSilence() {
    sent_.clear();
    const Time begin = now_;
    Run(2);
    ASSERT_EQ(sent_.size(), 3u);
    EXPECT_EQ(sent_[0].at, begin + milliseconds(10));
    EXPECT_LE(sent_[2].at, begin + milliseconds(130));
    for (const Sent& s : sent_) EXPECT_EQ(s.twist.vx, 0);
  }

  PilotConfig config_;
  Pilot dut_{config_};
  Stick stick_{.axis = {}, .buttons = 0, .connected = true, .heard = {}};
  RobotView robot_;
  bool talks_ = true, answers_ = true;
  Time now_ = FromUtime(1'000'000'000);
  std::vector<Sent> sent_;
  std::vector<HeadRates> head_;
  std::vector<PilotOutput::Lease> leases_;
  std::vector<PilotOutput::Estop> estops_;
};

TEST_F(PilotTest, AStickWithoutTheDeadManSaysNothing) {
  Push(1);
  Run(1);
  EXPECT_TRUE(sent_.empty());
  EXPECT_TRUE(leases_.empty());
}

TEST_F(PilotTest, TheDeadManAsksForAFreeLeaseAndSendsZerosUntilTheRobotAgrees) {
  Run(0.1);
  Hold(config_.buttons.dead_man);
  Push(1);
  Run(0.5);
  EXPECT_THAT(leases_, testing::ElementsAre(PilotOutput::Lease::kAcquire));
  EXPECT_EQ(dut_.phase(), PilotPhase::kAsking);
  EXPECT_GT(sent_.size(), 5u);
  EXPECT_EQ(Moving(), 0);
  robot_.lease = RobotView::Lease::kMine;
  Run(0.1);
  EXPECT_EQ(dut_.phase(), PilotPhase::kDriving);
  EXPECT_NEAR(sent_.back().twist.vx, config_.slow.speed_m_s, 1e-9);
}

TEST_F(PilotTest, CommandsComeAtTheirRateWhileTheStickIsDeflected) {
  DriveOff();
  Run(1);
  EXPECT_NEAR(static_cast<double>(sent_.size()), config_.rate_hz, 6);  // at the raster of the ticks
}

TEST_F(PilotTest, AHandThatChangesItsMindIsHeardWithinHalfAPeriod) {
  DriveOff();
  for (const double push : {-1.0, 0.5, -0.5, 1.0}) {
    Run(0.3);
    sent_.clear();
    Push(push);
    Run(0.5 / config_.rate_hz + 0.011);
    ASSERT_FALSE(sent_.empty());
    EXPECT_EQ(std::signbit(sent_.back().twist.vx), std::signbit(push));
  }
}

TEST_F(PilotTest, AStickThatIsLetGoSaysThreeZeros) {
  DriveOff();
  Push(0);
  LetGo(config_.buttons.dead_man);
  ExpectThreeZerosThenSilence();
}

TEST_F(PilotTest, ADeadManThatIsLetGoSaysThreeZerosAlthoughTheStickIsPushed) {
  DriveOff();
  LetGo(config_.buttons.dead_man);
  ExpectThreeZerosThenSilence();
}

TEST_F(PilotTest, AnUnpluggedMouseSaysThreeZeros) {
  DriveOff();
  stick_ = {};
  ExpectThreeZerosThenSilence();
}

TEST_F(PilotTest, APluggedInMouseWhoseButtonIsStuckDoesNotDrive) {
  DriveOff();
  const Stick held = stick_;
  stick_ = {};
  Run(0.5);
  sent_.clear();
  stick_ = held;
  Run(1);
  EXPECT_EQ(Moving(), 0);
  EXPECT_EQ(dut_.phase(), PilotPhase::kMustLetGo);
}

TEST_F(PilotTest, ADeflectedStickThatFallsSilentIsGone) {
  DriveOff();
  talks_ = false;
  Run(config_.silence_s + 0.02);
  ASSERT_FALSE(sent_.empty());
  EXPECT_EQ(sent_.back().twist.vx, 0);
  sent_.clear();
  Run(1);
  EXPECT_EQ(Moving(), 0);
}

TEST_F(PilotTest, AStickAtRestInTheHandKeepsTheLeaseWithAFewZeros) {
  DriveOff();
  Push(0);
  Run(0.3);
  sent_.clear();
  Run(2);
  EXPECT_EQ(sent_.size(), 4u);
  EXPECT_EQ(Moving(), 0);
}

TEST_F(PilotTest, WhoLosesTheLeaseMustLetGoBeforeHeDrivesAgain) {
  DriveOff();
  robot_.lease = RobotView::Lease::kOther;
  ExpectThreeZerosThenSilence();
  robot_.lease = RobotView::Lease::kFree;
  Run(1);
  EXPECT_EQ(Moving(), 0);
  EXPECT_EQ(dut_.phase(), PilotPhase::kMustLetGo);
}

TEST_F(PilotTest, AHeldLeaseIsTakenByTheButtonOnly) {
  robot_.lease = RobotView::Lease::kOther;
  Run(0.1);
  Hold(config_.buttons.dead_man);
  Run(2.5);
  EXPECT_THAT(leases_, testing::Each(PilotOutput::Lease::kAcquire));
  leases_.clear();
  Hold(config_.buttons.take_over);
  Run(0.5);
  EXPECT_THAT(leases_, testing::ElementsAre(PilotOutput::Lease::kTakeOver));
}

TEST_F(PilotTest, ARobotThatSaysNothingMoreIsNotDriven) {
  DriveOff();
  answers_ = false;
  Run(config_.status_stale_s + 0.1);
  sent_.clear();
  Run(1);
  EXPECT_EQ(Moving(), 0);
}

TEST_F(PilotTest, WhomTheRobotRefusedMotionMustLetGo) {
  DriveOff();
  robot_.refused += 3;
  robot_.refuses_motion = true;
  Run(0.1);
  EXPECT_EQ(dut_.phase(), PilotPhase::kMustLetGo);
  LetGo(config_.buttons.dead_man);
  Push(0);
  Run(0.1);
  Hold(config_.buttons.dead_man);
  Run(0.1);
  EXPECT_EQ(dut_.phase(), PilotPhase::kDriving) << "an old refusal does not count again";
}

TEST_F(PilotTest, ARobotThatIsNotHeardIsToldToStandUntilItIs) {
  DriveOff();
  answers_ = false;
  LetGo(config_.buttons.dead_man);
  Run(2);
  EXPECT_GE(sent_.size(), 5u) << "three zeros, and twice a second";
  EXPECT_EQ(Moving(), 0);
  answers_ = true;
  Run(0.1);
  sent_.clear();
  Run(2);
  EXPECT_EQ(sent_.size(), 0u);
}

TEST_F(PilotTest, ACommandThatCameTooLateDoesNotEndTheDrive) {
  DriveOff();
  ++robot_.refused;
  Run(0.1);
  EXPECT_EQ(dut_.phase(), PilotPhase::kDriving);
}

TEST_F(PilotTest, TheEstopButtonStopsAtOnceAndAgainUntilTheRobotSaysSo) {
  DriveOff();
  Hold(config_.buttons.estop);
  Tick();
  EXPECT_THAT(estops_, testing::ElementsAre(PilotOutput::Estop::kStop));
  Run(2.2);
  EXPECT_EQ(estops_.size(), 3u);
  EXPECT_EQ(Moving(), 0);
  robot_.estop = true;
  Run(2);
  EXPECT_EQ(estops_.size(), 3u);
}

TEST_F(PilotTest, TheEstopWorksWithoutDeadManAndLease) {
  Run(0.1);
  robot_.lease = RobotView::Lease::kOther;
  Hold(config_.buttons.estop);
  Tick();
  EXPECT_THAT(estops_, testing::ElementsAre(PilotOutput::Estop::kStop));
}

TEST_F(PilotTest, RearmingTakesAHeldButtonAndAStickAtRest) {
  robot_.estop = true;
  Run(0.1);
  Hold(config_.buttons.rearm);
  Run(config_.rearm_hold_s - 0.1);
  EXPECT_TRUE(estops_.empty()) << "too short";
  Push(1);
  Run(2);
  EXPECT_TRUE(estops_.empty()) << "the stick is pushed";
  Push(0);
  LetGo(config_.buttons.rearm);
  Run(0.1);
  Hold(config_.buttons.rearm);
  Run(config_.rearm_hold_s + 3);
  EXPECT_THAT(estops_, testing::ElementsAre(PilotOutput::Estop::kRearm));
}

TEST_F(PilotTest, ADeadManHeldThroughTheEstopDoesNotDriveAfterIt) {
  DriveOff();
  Click(config_.buttons.estop);
  robot_.estop = true;
  Run(0.5);
  robot_.estop = false;
  sent_.clear();
  Run(1);
  EXPECT_EQ(Moving(), 0);
  EXPECT_EQ(dut_.phase(), PilotPhase::kMustLetGo);
}

TEST_F(PilotTest, TheModeButtonGivesTheStickToTheHead) {
  Run(0.1);
  Click(config_.buttons.mode);
  EXPECT_EQ(dut_.mode(), PilotMode::kHead);
  Hold(config_.buttons.dead_man);
  robot_.lease = RobotView::Lease::kMine;
  Run(0.1);
  stick_.axis[5] = 1;
  Run(0.5);
  ASSERT_FALSE(head_.empty());
  EXPECT_NEAR(head_.back().pan_rad_s, config_.head.pan_rad_s, 1e-9);
  EXPECT_TRUE(std::all_of(sent_.begin(), sent_.end(), [](const Sent& s) { return s.twist.wz == 0; }));
  head_.clear();
  LetGo(config_.buttons.dead_man);
  Run(1);
  EXPECT_EQ(head_, (std::vector<HeadRates>(3)));
}

TEST_F(PilotTest, TogglingWithADeflectedStickEndsTheMotion) {
  DriveOff();
  Hold(config_.buttons.mode);
  Run(0.5);
  LetGo(config_.buttons.mode);
  sent_.clear();
  Run(0.5);
  EXPECT_EQ(Moving(), 0);
  EXPECT_TRUE(head_.empty() || head_.back() == HeadRates{});
}

TEST_F(PilotTest, TheRangeButtonChangesTheSpeed) {
  DriveOff();
  Click(config_.buttons.range);
  Run(0.1);
  EXPECT_NEAR(sent_.back().twist.vx, config_.fast.speed_m_s, 1e-9);
}

TEST_F(PilotTest, FullDeflectionAlongBothAxesIsNotFaster) {
  DriveOff();
  stick_.axis[1] = 1;
  Run(0.1);
  EXPECT_NEAR(std::hypot(sent_.back().twist.vx, sent_.back().twist.vy), config_.slow.speed_m_s, 1e-9);
}

}  // namespace
}  // namespace priamos
