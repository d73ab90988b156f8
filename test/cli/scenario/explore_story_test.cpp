#include "cli/scenario/explore_story.hpp"

#include <gmock/gmock.h>

#include "stage.hpp"

namespace priamos::cli {
namespace {

Scenario Floor() {
  Scenario scenario;
  scenario.story = "explore";
  scenario.time_limit_s = 60;
  scenario.processes.resize(1);
  scenario.processes[0].module = "robot";
  scenario.processes[0].bus = "onboard";
  return scenario;
}

/// The story, and the planner that it talks to.
struct FloorStage : Stage {
  FloorStage() : Stage(Floor()) {}
  void RunTo(std::int8_t outcome, const std::string& text) {
    Live();
    status.Publish(mission_status_t{});
    Run(0.3);
    for (const auto& order : orders.Drain()) given = order;
    mission_status_t message{};
    message.order_id = given.order_id;
    mission_result_t result{};
    result.order_id = given.order_id;
    result.outcome = outcome;
    result.text = text;
    message.results = {result};
    message.n_results = 1;
    status.Publish(message);
    Run(0.2);
  }
  bus::Publisher<mission_status_t> status = offboard_other.Advertise(channels::kMissionStatus);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
  mission_command_t given{};
};

TEST(ExploreStory, OrdersTheExplorationWithoutAnyWaypoint) {
  FloorStage stage;
  stage.RunTo(mission_result_t::DONE, "explored 58 m2 in 200 s, 40 m driven");
  EXPECT_EQ(stage.given.mission, mission_command_t::EXPLORE);
  EXPECT_TRUE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "explored 58 m2 in 200 s, 40 m driven");
}

TEST(ExploreStory, AnOrderThatFailedIsNoGoodEnd) {
  FloorStage stage;
  stage.RunTo(mission_result_t::FAILED, "the robot touched something");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_THAT(stage.story->Reason(), ::testing::HasSubstr("the robot touched something"));
}

}  // namespace
}  // namespace priamos::cli
