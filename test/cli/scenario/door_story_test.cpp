#include "cli/scenario/door_story.hpp"

#include <gmock/gmock.h>

#include "stage.hpp"

namespace priamos::cli {
namespace {

TEST(LookTextTest, AFixSaysWhatItRestsOnAndHowSureItIs) {
  landmark_fix_t look{};
  look.side = 1;
  look.n_matched = 24;
  look.sigma_x_m = 0.003;
  look.sigma_y_m = 0.004;
  look.sigma_yaw_rad = 0.01;
  EXPECT_EQ(LookText(look), "  left side found: 24 edges, 1 sigma 0.5 cm and 0.57 degrees");
}

TEST(LookTextTest, AFailureSaysWhy) {
  landmark_fix_t look{};
  look.side = 2;
  look.verdict = landmark_fix_t::TOO_FEW_EDGES;
  EXPECT_EQ(LookText(look), "  right side not found: too few edges");
}

TEST(LookTextTest, AnUnknownSideIsNoReasonToFall) {
  landmark_fix_t look{};
  look.verdict = landmark_fix_t::NO_IMAGE;
  for (const int side : {-128, -1, 3, 127}) {
    look.side = static_cast<std::int8_t>(side);
    EXPECT_NE(LookText(look).find("not found: no image"), std::string::npos);
  }
}

Scenario TwoProcesses() {
  Scenario scenario;
  scenario.landmark_id = 3;
  scenario.time_limit_s = 60;
  scenario.processes.resize(2);
  scenario.processes[0].module = "robot";
  scenario.processes[0].bus = "onboard";
  scenario.processes[1].module = "planner";
  scenario.processes[1].bus = "offboard";
  return scenario;
}

/// The door's story, and the planner that it talks to.
struct DoorStage : Stage {
  DoorStage() : Stage(TwoProcesses()) {}
  /// The planner says so, and the story hears it.
  void Say(int phase, const std::string& text) {
    mission_status_t message{};
    message.phase = static_cast<std::int8_t>(phase);
    message.text = text;
    status.Publish(message);
    Run(0.1);
  }
  bus::Publisher<mission_status_t> status = offboard_other.Advertise(channels::kMissionStatus);
  bus::Publisher<landmark_fix_t> looks = offboard_other.Advertise(channels::kLandmarkFix);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
};

TEST(DoorStory, NamesTheProcessesThatItWaitsFor) {
  DoorStage stage;
  stage.Run(1);
  EXPECT_EQ(stage.story->Reason(), "no sign of life from onboard robot, offboard planner");
  stage.Live("robot");
  stage.Run(1);
  EXPECT_EQ(stage.story->Reason(), "no sign of life from onboard robot");
  EXPECT_FALSE(stage.story->Started());
  EXPECT_TRUE(stage.orders.Drain().empty());
}

TEST(DoorStory, OrdersTheDoorOnceAllAreAliveAndAgainUntilThePlannerMoves) {
  DoorStage stage;
  stage.Live();
  stage.Run(1);
  auto orders = stage.orders.Drain();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].mission, mission_command_t::PASS_DOOR);
  EXPECT_EQ(orders[0].landmark_id, 3);
  EXPECT_TRUE(stage.story->Started());
  stage.Run(2);
  EXPECT_EQ(stage.orders.Drain().size(), 1u) << "the first one was lost";
  stage.Say(mission_status_t::APPROACHING, "approaching");
  stage.Run(5);
  EXPECT_TRUE(stage.orders.Drain().empty());
}

TEST(DoorStory, EndsSomeTimeAfterTheMissionWithItsLastWords) {
  for (const bool passes : {true, false}) {
    DoorStage stage;
    stage.Live();
    stage.Run(1);
    stage.Say(mission_status_t::PASSING, "passing");
    stage.Say(passes ? mission_status_t::DONE : mission_status_t::FAILED, "the end");
    stage.Say(mission_status_t::WAITING, "no order yet");
    EXPECT_FALSE(stage.Done()) << "the last messages cross the radio";
    stage.Run(1.5);
    EXPECT_TRUE(stage.Done());
    EXPECT_EQ(stage.story->Succeeded(), passes);
    EXPECT_EQ(stage.story->Reason(), "the end");
    EXPECT_FALSE(stage.story->DecidesTheRun());
  }
}

TEST(DoorStory, AtTheTimeLimitItSaysHowFarItCame) {
  DoorStage stage;
  stage.Live();
  stage.Run(1);
  stage.Say(mission_status_t::PASSING, "passing the door");
  stage.Run(60);
  EXPECT_TRUE(stage.Done());
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "time limit of 60 s reached while: passing the door");
}

TEST(DoorStory, ReportsPhasesOnceAndEveryLook) {
  DoorStage stage;
  stage.Say(mission_status_t::FAILED, "of an earlier run");
  stage.Live();
  stage.Run(1);
  stage.Say(mission_status_t::APPROACHING, "approaching");
  stage.Say(mission_status_t::APPROACHING, "approaching still");
  landmark_fix_t look{};
  look.verdict = landmark_fix_t::NO_IMAGE;
  stage.looks.Publish(look);
  stage.looks.Publish(look);
  stage.Run(0.1);
  const std::string no_image = "  landmark not found: no image";
  EXPECT_THAT(stage.told, testing::ElementsAre("all processes are alive; order to the planner: pass the door",
                                               "approaching", no_image, no_image));
}

}  // namespace
}  // namespace priamos::cli
