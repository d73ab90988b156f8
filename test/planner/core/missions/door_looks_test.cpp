#include <gmock/gmock.h>

#include "door_mission_story.hpp"

namespace priamos::planner {
namespace {

using ::testing::HasSubstr;

TEST(DoorLooks, LooksAtTheLeftSideFirstThenAtTheRightSide) {
  DoorStory s;
  s.Start();
  s.robot.RunFor(60);
  ASSERT_GE(s.robot.looks.size(), 2u);
  EXPECT_EQ(s.robot.looks[0].side, Side::kLeft);
  EXPECT_EQ(s.robot.looks[1].side, Side::kRight);
}

TEST(DoorLooks, SideThatWasNotFoundIsLookedAtAgainAfterTheOther) {
  DoorStory s;
  s.robot.answer = [](const LookOrder& look, int n) {
    return LookResult{look.request_id, n != 0, n != 0 ? "" : "too few edges", false};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  ASSERT_GE(s.robot.looks.size(), 3u);
  EXPECT_EQ(s.robot.looks[1].side, Side::kRight);
  EXPECT_EQ(s.robot.looks[2].side, Side::kLeft);
  EXPECT_NE(s.robot.looks[0].request_id, s.robot.looks[1].request_id);
  EXPECT_EQ(s.robot.models_received, 1);
}

TEST(DoorLooks, DoorWithOneSideOutOfSightIsPassedAllTheSame) {
  DoorStory s;
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, look.side == Side::kRight, "not visible from there", false};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorLooks, HeadThatLostTheModelGetsItAgainBeforeTheNextLook) {
  DoorStory s;
  s.robot.answer = [&s](const LookOrder& look, int n) {
    EXPECT_EQ(s.robot.models_received, n == 0 ? 1 : 2);
    return LookResult{look.request_id, n != 0, "the head has no model of it", n == 0};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorLooks, SaysWhyItLooksAgain) {
  DoorStory s;
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "no image", false};
  };
  s.Start();
  for (int i = 0; i < 1000 && s.dut.state().text.find("not found") == std::string::npos; ++i) s.robot.Step();
  EXPECT_EQ(s.dut.state().text, "left side of the door not found: no image");
  EXPECT_EQ(s.dut.state().phase, Phase::kLookingLeft);
}

/// From near a picture holds too little of the door to find it where its place is hardly known.
TEST(DoorLooks, LooksThatFailFromNearAreRepeatedFromFartherBack) {
  DoorStory s;
  s.robot.answer = [&s](const LookOrder& look, int) {
    return LookResult{look.request_id, s.robot.truth().x < 6 - 2.4 && s.robot.paths.size() > 1, "", false};
  };
  s.Start();
  s.robot.RunUntil(Phase::kRetreating);
  EXPECT_GT(s.robot.truth().x, 6 - 1.9);
  EXPECT_THAT(s.dut.state().text, HasSubstr("9 looks failed"));
  EXPECT_THAT(s.dut.state().text, HasSubstr("back to 2.6 m before the door, to see more of it"));
  s.robot.RunUntil(Phase::kLookingLeft);
  EXPECT_NEAR(s.robot.truth().x, 6 - 2.6, 0.05);
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

TEST(DoorLooks, GivesUpWithTheReasonAndBrakes) {
  DoorStory s;
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "ambiguous", false};
  };
  s.Start();
  s.robot.RunFor(90);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("looks failed, the last one: left side of the door not found"));
  for (int i = 0; i < 10; ++i) s.robot.Step();
  EXPECT_TRUE(s.robot.paths.back().points.empty());
  EXPECT_NEAR(s.robot.truth().x, 6 - 2.6, 0.05) << "it went back once, and stays there";
}

/// Who cannot go back, or shall not, gives up where it stands.
TEST(DoorLooks, WithoutRoomBehindItGivesUpAtTheHoldPoint) {
  DoorMissionConfig config;
  config.stand_back_m = 0;
  DoorStory s({2.0, 2.4, 0}, ShippedPlan(), config);
  s.robot.answer = [](const LookOrder& look, int) {
    return LookResult{look.request_id, false, "ambiguous", false};
  };
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_EQ(
      s.dut.state().text,
      "9 looks failed, the last one: left side of the door not found: ambiguous; next: look whether the "
      "door is shut or hidden, and order it again");
  EXPECT_GT(s.robot.truth().x, 6 - 1.9);
}

TEST(DoorLooks, AnswerToAnEarlierRequestIsNotTaken) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kLookingLeft);
  s.dut.OnLook({1, true, "", false});
  s.robot.Step();
  EXPECT_EQ(s.dut.state().phase, Phase::kLookingLeft);
}

TEST(DoorLooks, HeadThatNeverAnswersIsAskedAgainThenGivenUp) {
  DoorStory s;
  s.robot.look_time = std::chrono::seconds(1000);
  s.Start();
  s.robot.RunFor(110);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("side of the door not found: no answer"));
}

TEST(DoorLooks, UncertainPoseIsLookedAtAgainAndThenRefused) {
  DoorStory s;
  s.robot.sigma_after_m = 0.05;
  s.Start();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kFailed);
  EXPECT_THAT(s.dut.state().text, HasSubstr("too uncertain for the gap"));
  EXPECT_EQ(s.robot.looks.size(), 16u);
  EXPECT_LT(s.robot.truth().x, 6 - 1.1);
}

TEST(DoorLooks, PassesWithoutStoppingWhenBothSidesWereSeenSinceLooksGoOn) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  ASSERT_EQ(s.robot.looks.size(), 2u);
  EXPECT_NE(s.robot.looks[0].side, s.robot.looks[1].side);
  EXPECT_LT(s.robot.look_distance_m[1], s.robot.look_distance_m[0]);
  EXPECT_GT(s.robot.speed_m_s(), 0.2);
}

TEST(DoorLooks, LooksGoOnWhilePassingUntilTheJambsLeaveThePicture) {
  DoorStory s;
  s.robot.sigma_m = s.robot.sigma_after_m = 0.002;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  const std::size_t before = s.robot.looks.size();
  s.robot.RunFor(60);
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
  EXPECT_GT(s.robot.looks.size(), before);
  EXPECT_GT(s.robot.look_distance_m.back(), DoorMissionConfig().confirm_to_m - 0.4);
}

TEST(DoorLooks, NearTheDoorLooksStayOnOneSide) {
  DoorStory s;
  s.robot.sigma_m = s.robot.sigma_after_m = 0.002;
  s.Start();
  s.robot.RunFor(60);
  int near = 0;
  for (std::size_t i = 1; i < s.robot.looks.size(); ++i) {
    if (s.robot.look_distance_m[i] > DoorMissionConfig().one_side_m - 0.3) continue;
    ++near;
    EXPECT_EQ(s.robot.looks[i].side, s.robot.looks[i - 1].side) << s.robot.look_distance_m[i];
  }
  EXPECT_GE(near, 1);
}

TEST(DoorLooks, ABaseThatWaitedLongInTheApproachStillLooks) {
  DoorStory s;
  s.Start();
  s.robot.RunUntil(Phase::kPassing);
  s.robot.blocked = true;
  const std::size_t before = s.robot.looks.size();
  s.robot.RunFor(7);
  s.robot.blocked = false;
  const std::size_t waiting = s.robot.looks.size();
  s.robot.RunFor(60);
  EXPECT_GT(waiting, before);
  EXPECT_GT(s.robot.looks.size(), waiting + 1) << "looks that succeeded were counted as used up";
  EXPECT_EQ(s.dut.state().phase, Phase::kDone) << s.dut.state().text;
}

}  // namespace
}  // namespace priamos::planner
