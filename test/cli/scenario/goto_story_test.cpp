#include "cli/scenario/goto_story.hpp"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

#include "mission_stage.hpp"

namespace priamos::cli {
namespace {

Scenario TwoPlaces() {
  Scenario scenario = ScenarioOf("goto");
  scenario.waypoints = {{.x_m = 4, .y_m = 1, .yaw_deg = 90}, {.x_m = 2, .y_m = 2, .yaw_deg = 0}};
  return scenario;
}

/// The story, the planner that it talks to, and the true robot.
struct GotoStage : Stage {
  explicit GotoStage(const Scenario& scenario = TwoPlaces()) : Stage(scenario) {}
  void Say(int phase, const std::string& text) {
    mission_status_t message{};
    message.phase = static_cast<std::int8_t>(phase);
    message.text = text;
    Listen();
    message.order_id = order_id;
    const bool over = phase == mission_status_t::DONE || phase == mission_status_t::FAILED;
    message.running = order_id != 0 && !over;
    if (over) {
      mission_result_t result{};
      result.order_id = order_id;
      result.outcome = phase == mission_status_t::DONE ? mission_result_t::DONE : mission_result_t::FAILED;
      result.text = text;
      message.results.push_back(result);
      message.n_results = 1;
    }
    status.Publish(message);
    Run(0.1);
  }
  /// The orders since the last call.
  std::vector<mission_command_t> Given() {
    Listen();
    return std::exchange(given, {});
  }
  void Listen() {
    for (const auto& order : orders.Drain()) {
      given.push_back(order);
      order_id = order.order_id;
    }
  }
  void Stand(double x_m, double y_m) {
    world_truth_t message{};
    message.x_m = x_m;
    message.y_m = y_m;
    truth.Publish(message);
    Run(0.1);
  }
  /// The processes live, and the first order is given.
  void Begin() {
    Live();
    Say(mission_status_t::WAITING, "no order yet");
    Run(0.3);
  }
  bus::Publisher<mission_status_t> status = offboard_other.Advertise(channels::kMissionStatus);
  bus::Publisher<world_truth_t> truth = onboard_other.Advertise(channels::kWorldTruth);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
  std::vector<mission_command_t> given;
  int order_id = 0;  ///< of the last order that the planner took
};

TEST(GotoStory, OrdersOnePlaceAfterTheOther) {
  GotoStage stage;
  stage.Begin();
  auto orders = stage.Given();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].mission, mission_command_t::GOTO);
  EXPECT_EQ(orders[0].x_m, 4);
  EXPECT_TRUE(orders[0].turn);
  stage.Say(mission_status_t::DRIVING, "driving");
  stage.Stand(4.1, 1);
  for (int i = 0; i < 2; ++i) stage.Say(mission_status_t::DONE, "at (4, 1)");
  stage.Run(0.3);
  orders = stage.Given();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(orders[0].x_m, 2);
  stage.Say(mission_status_t::DRIVING, "driving");
  stage.Stand(2, 2.05);
  stage.Say(mission_status_t::DONE, "at (2, 2)");
  EXPECT_TRUE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "at all 2 waypoints, 0.10 m off at most");
}

TEST(GotoStory, APlannerThatOnlyBelievesToBeThereHasNotSucceeded) {
  GotoStage stage;
  stage.Begin();
  stage.Say(mission_status_t::DRIVING, "driving");
  stage.Stand(4.6, 1);
  stage.Say(mission_status_t::DONE, "at (4, 1)");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "the base is 0.60 m from waypoint 1");
  stage.Run(2);
  EXPECT_TRUE(stage.Done());
}

TEST(GotoStory, AFailedMissionEndsItWithTheReason) {
  GotoStage stage;
  stage.Begin();
  stage.Say(mission_status_t::DRIVING, "driving");
  stage.Say(mission_status_t::FAILED, "no way");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "waypoint 1: failed: no way");
}

TEST(GotoStory, WithoutWaypointsThereIsNothingToDo) {
  Scenario scenario = TwoPlaces();
  scenario.waypoints.clear();
  GotoStage stage(scenario);
  stage.Live();
  stage.Run(0.2);
  EXPECT_EQ(stage.story->Reason(), "the scenario has no waypoint");
}

}  // namespace
}  // namespace priamos::cli
