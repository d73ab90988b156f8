#include "head/core/motion/look_sequence.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

using Action = LookSequence::Action;

class LookSequenceTest : public testing::Test {
 protected:
  Action Step(bool settled, bool failed = false, double seconds = 0.02) {
    now_ += FromSeconds(seconds);
    return dut_.Step(settled, failed, now_);
  }
  void Deliver(int camera, std::int32_t frame_id) { dut_.Add({now_, frame_id, camera, camera, 768, 576}); }

  Time now_{std::chrono::seconds(50)};
  LookSequence dut_{LookConfig{}};
};

TEST_F(LookSequenceTest, ExposesOnlyWhenTheHeadRests) {
  dut_.Begin(now_);
  EXPECT_EQ(Step(false), Action::kWait);
  EXPECT_EQ(Step(true), Action::kTrigger);
}

TEST_F(LookSequenceTest, UsesThePicturesWhenAllAreThere) {
  dut_.Begin(now_);
  Step(true);
  Deliver(0, dut_.frame_id());
  EXPECT_EQ(Step(true), Action::kWait);
  Deliver(1, dut_.frame_id());
  EXPECT_EQ(Step(true), Action::kUseFrames);
  EXPECT_EQ(dut_.frames()[1].camera, 1);
}

TEST_F(LookSequenceTest, IgnoresPicturesOfOtherExposures) {
  dut_.Begin(now_);
  Step(true);
  Deliver(0, dut_.frame_id() - 1);
  Deliver(1, dut_.frame_id() - 1);
  EXPECT_EQ(Step(true), Action::kWait);
}

TEST_F(LookSequenceTest, ExposesAgainWhenAPictureIsLost) {
  dut_.Begin(now_);
  Step(true);
  const auto first = dut_.frame_id();
  Deliver(0, first);
  EXPECT_EQ(Step(true, false, 0.6), Action::kTrigger);
  EXPECT_NE(dut_.frame_id(), first);
}

TEST_F(LookSequenceTest, GivesUpAfterSomeAttempts) {
  dut_.Begin(now_);
  for (int i = 0; i < LookConfig{}.attempts; ++i) EXPECT_EQ(Step(true, false, 0.6), Action::kTrigger);
  EXPECT_EQ(Step(true, false, 0.6), Action::kGiveUp);
}

TEST_F(LookSequenceTest, AHeadThatMovesSpoilsThePair) {
  dut_.Begin(now_);
  Step(true);
  EXPECT_EQ(Step(false), Action::kWait);
  Deliver(0, dut_.frame_id());
  Deliver(1, dut_.frame_id());
  EXPECT_EQ(Step(true), Action::kTrigger);
}

TEST_F(LookSequenceTest, GivesUpWhenTheHeadFails) {
  dut_.Begin(now_);
  EXPECT_EQ(Step(false, true), Action::kGiveUp);
}

TEST_F(LookSequenceTest, NeverLastsLongerThanTheAgeLimit) {
  dut_.Begin(now_);
  EXPECT_EQ(Step(false, false, LookConfig{}.age_limit_s + 0.1), Action::kGiveUp);
}

TEST_F(LookSequenceTest, AThirdPictureThatDoesNotComeIsDoneWithout) {
  dut_ = LookSequence(LookConfig{}, 3);
  dut_.Begin(now_);
  ASSERT_EQ(Step(true), Action::kTrigger);
  EXPECT_EQ(dut_.camera_mask(), 7);
  Deliver(0, dut_.frame_id());
  Deliver(1, dut_.frame_id());
  EXPECT_EQ(Step(true), Action::kWait);
  EXPECT_EQ(Step(true, false, 0.6), Action::kUseFrames);
  EXPECT_EQ(dut_.frames().size(), 2u);
}

TEST_F(LookSequenceTest, OneLookMayTakeFewerPictures) {
  dut_ = LookSequence(LookConfig{}, 3);
  dut_.Begin(now_, LookSequence::kPair);
  ASSERT_EQ(Step(true), Action::kTrigger);
  EXPECT_EQ(dut_.camera_mask(), 3);
  Deliver(0, dut_.frame_id());
  Deliver(1, dut_.frame_id());
  EXPECT_EQ(Step(true), Action::kUseFrames);
  dut_.End();
  dut_.Begin(now_);
  ASSERT_EQ(Step(true), Action::kTrigger);
  EXPECT_EQ(dut_.camera_mask(), 7) << "the next one takes all";
}

/// On a log.
class RecordedLook : public LookSequenceTest {
 protected:
  RecordedLook() { dut_ = LookSequence(LookConfig{}, 2, LookSequence::Exposures::kRecorded); }
};

TEST_F(RecordedLook, UsesThePicturesOfTheLogWhereverTheHeadPoints) {
  for (const std::int32_t frame_id : {7, 9, 9}) {
    dut_.Begin(now_);
    EXPECT_EQ(Step(true), Action::kWait) << "exposes nothing";
    Deliver(0, frame_id);
    EXPECT_EQ(Step(false, true), Action::kWait);
    Deliver(1, frame_id);
    EXPECT_EQ(Step(false, true), Action::kUseFrames);
    EXPECT_EQ(dut_.frames()[0].frame_id, frame_id);
    dut_.End();
  }
}

TEST_F(RecordedLook, PicturesBeforeItBeganAndHalvesOfTwoExposuresAreNone) {
  Deliver(0, 3);
  Deliver(1, 3);
  dut_.Begin(now_);
  EXPECT_EQ(Step(true), Action::kWait);
  Deliver(0, 4);
  Deliver(1, 5);
  EXPECT_EQ(Step(true), Action::kWait);
  Deliver(0, 5);
  EXPECT_EQ(Step(true), Action::kUseFrames);
}

TEST_F(RecordedLook, ALogOfTwoCamerasHasNoThirdPicture) {
  dut_ = LookSequence(LookConfig{}, 3, LookSequence::Exposures::kRecorded);
  dut_.Begin(now_);
  Deliver(0, 4);
  Deliver(1, 4);
  EXPECT_EQ(Step(true), Action::kWait);
  EXPECT_EQ(Step(true, false, 0.6), Action::kUseFrames);
}

TEST_F(RecordedLook, EndsWithoutPictures) {
  dut_.Begin(now_);
  EXPECT_EQ(Step(true, false, LookConfig{}.age_limit_s + 1), Action::kGiveUp);
}

}  // namespace
}  // namespace priamos::head
