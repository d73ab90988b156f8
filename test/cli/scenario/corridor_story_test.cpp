#include "cli/scenario/corridor_story.hpp"

#include <gmock/gmock.h>

#include "stage.hpp"

namespace priamos::cli {
namespace {

Scenario Corridor() {
  Scenario scenario;
  scenario.story = "corridor";
  scenario.time_limit_s = 60;
  scenario.processes.resize(1);
  scenario.processes[0].module = "robot";
  scenario.processes[0].bus = "onboard";
  scenario.waypoints = {{.x_m = 20, .y_m = 0, .yaw_deg = 0}};
  return scenario;
}

/// The story, the planner that it talks to, and the true robot.
struct CorridorStage : Stage {
  CorridorStage() : Stage(Corridor()) {}
  /// The processes live, the order is given and taken, and its end is told with the base truly there.
  void RunTo(double x_m, std::int8_t outcome, const std::string& text) {
    Live();
    status.Publish(mission_status_t{});
    Run(0.3);
    for (const auto& order : orders.Drain()) given = order;
    world_truth_t there{};
    there.x_m = x_m;
    there.y_m = 0.4;
    truth.Publish(there);
    Run(0.1);
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
  bus::Publisher<world_truth_t> truth = onboard_other.Advertise(channels::kWorldTruth);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
  mission_command_t given{};
};

TEST(CorridorStory, OrdersTheCorridorToItsEndAndTheBaseTrulyIsThere) {
  CorridorStage stage;
  stage.RunTo(20.3, mission_result_t::DONE, "at the end of the corridor after 18.0 m in 70 s");
  EXPECT_EQ(stage.given.mission, mission_command_t::CORRIDOR);
  EXPECT_EQ(stage.given.distance_m, 0);
  EXPECT_TRUE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "at the end of the corridor after 18.0 m in 70 s");
}

TEST(CorridorStory, AnEndThatIsElsewhereIsNone) {
  CorridorStage stage;
  stage.RunTo(12, mission_result_t::DONE, "at the end of the corridor after 10.0 m in 40 s");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "the base is 8.01 m from the corridor's end");
}

TEST(CorridorStory, AFailedMissionEndsItWithTheReason) {
  CorridorStage stage;
  stage.RunTo(12, mission_result_t::FAILED, "the corridor is closed");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "failed: the corridor is closed");
}

}  // namespace
}  // namespace priamos::cli
