#include "head/core/motion/head_positioner.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

/// Motors that reach every command after a while.
class FakeMotors {
 public:
  void Command(const HeadSetting& setting, Time now) {
    target_ = setting;
    arrival_ = now + std::chrono::milliseconds(200);
    if (commands_.empty() || !IsSameSetting(commands_.back(), setting, 1e-9)) commands_.push_back(setting);
  }
  HeadReport Report(Time now) {
    if (now >= arrival_) at_ = target_;
    return {now, at_, now < arrival_};
  }
  std::vector<HeadSetting> commands_;

 private:
  HeadSetting target_, at_;
  Time arrival_{};
};

HeadSetting Left() {
  return {0.0873, 0, {-0.02, 0.02}, {650, 650}, {1600, 1600}};
}

class HeadPositionerTest : public testing::Test {
 protected:
  /// Runs until settled, failed or `seconds` are over.
  void Run(double seconds, bool connected = true) {
    const Time end = now_ + FromSeconds(seconds);
    while (now_ < end && !dut_.settled() && !dut_.failed()) Tick(connected);
  }
  void Tick(bool connected = true) {
    now_ += std::chrono::milliseconds(20);
    const HeadReport report = motors_.Report(now_);
    const auto command = dut_.Step(connected ? &report : nullptr, now_);
    if (command && connected) motors_.Command(*command, now_);
  }

  Time now_{std::chrono::seconds(100)};
  FakeMotors motors_;
  HeadPositioner dut_{PositionerConfig{}};
};

TEST_F(HeadPositionerTest, SaysNothingWithoutGoal) {
  Tick();
  EXPECT_FALSE(dut_.settled());
  EXPECT_TRUE(motors_.commands_.empty());
}

TEST_F(HeadPositionerTest, ArrivesFromBelow) {
  dut_.MoveTo(Left(), now_);
  Run(3);
  ASSERT_TRUE(dut_.settled());
  ASSERT_EQ(motors_.commands_.size(), 2u);
  EXPECT_LT(motors_.commands_[0].pan_rad, Left().pan_rad - 0.003);
  EXPECT_LT(motors_.commands_[0].focus_step[1], Left().focus_step[1]);
  EXPECT_TRUE(IsSameSetting(motors_.commands_[1], Left(), 1e-9));
}

TEST_F(HeadPositionerTest, EveryMotorArrivesFromBelow) {
  const HeadSetting goal = Left();
  const PositionerConfig config;
  dut_.MoveTo(goal, now_);
  Run(3);
  ASSERT_EQ(motors_.commands_.size(), 2u);
  const HeadSetting& below = motors_.commands_[0];
  EXPECT_NEAR(below.pan_rad, goal.pan_rad - config.approach_rad, 1e-12);
  EXPECT_NEAR(below.tilt_rad, goal.tilt_rad - config.approach_rad, 1e-12);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(below.vergence_rad[i], goal.vergence_rad[i] - config.approach_rad, 1e-12) << i;
    EXPECT_EQ(below.zoom_step[i], goal.zoom_step[i] - config.approach_steps) << i;
    EXPECT_EQ(below.focus_step[i], goal.focus_step[i] - config.approach_steps) << i;
  }
}

TEST_F(HeadPositionerTest, ApproachesFromBelowAlsoWhenItComesFromAbove) {
  HeadSetting above = Left();
  above.pan_rad = 0.5;
  dut_.MoveTo(above, now_);
  Run(3);
  dut_.MoveTo(Left(), now_);
  Run(3);
  ASSERT_TRUE(dut_.settled());
  ASSERT_EQ(motors_.commands_.size(), 4u);
  EXPECT_LT(motors_.commands_[2].pan_rad, Left().pan_rad);
}

TEST_F(HeadPositionerTest, RestsForTheSettlingTime) {
  dut_.MoveTo(Left(), now_);
  const Time start = now_;
  Run(3);
  EXPECT_GE(Seconds(now_ - start), 2 * 0.2 + PositionerConfig{}.settle_s);
}

TEST_F(HeadPositionerTest, SameGoalAgainNeedsNoMotion) {
  dut_.MoveTo(Left(), now_);
  Run(3);
  dut_.MoveTo(Left(), now_);
  EXPECT_TRUE(dut_.settled());
}

TEST_F(HeadPositionerTest, RepeatsALostCommand) {
  dut_.MoveTo(Left(), now_);
  for (int i = 0; i < 20; ++i) {  // nobody obeys
    now_ += std::chrono::milliseconds(20);
    const HeadReport report = motors_.Report(now_);
    dut_.Step(&report, now_);
  }
  Run(3);
  EXPECT_TRUE(dut_.settled());
}

TEST_F(HeadPositionerTest, FailsWhenNothingIsReported) {
  dut_.MoveTo(Left(), now_);
  Run(10, false);
  EXPECT_TRUE(dut_.failed());
  EXPECT_FALSE(dut_.settled());
}

TEST_F(HeadPositionerTest, ApproachesAgainWhenSomebodyMovesTheHead) {
  dut_.MoveTo(Left(), now_);
  Run(3);
  HeadSetting other = Left();
  other.pan_rad = -0.2;
  motors_.Command(other, now_);
  Tick();
  EXPECT_FALSE(dut_.settled());
  Run(3);
  EXPECT_TRUE(dut_.settled());
  EXPECT_NEAR(motors_.Report(now_).setting.pan_rad, Left().pan_rad, 1e-9);
}

}  // namespace
}  // namespace priamos::head
