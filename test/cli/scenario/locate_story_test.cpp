#include "cli/scenario/locate_story.hpp"

#include <gmock/gmock.h>

#include "stage.hpp"

namespace priamos::cli {
namespace {

Scenario Kidnapped() {
  Scenario scenario;
  scenario.story = "locate";
  scenario.time_limit_s = 60;
  scenario.processes.resize(1);
  scenario.processes[0].module = "robot";
  scenario.processes[0].bus = "onboard";
  return scenario;
}

/// The story, the planner that it talks to, and the true robot.
struct LocateStage : Stage {
  LocateStage() : Stage(Kidnapped()) {}
  /// The processes live, the order is given and taken; its end is told with the base truly at x 3 m.
  void RunTo(double pose_x_m, std::int8_t outcome, const std::string& text) {
    Live();
    status.Publish(mission_status_t{});
    Run(0.3);
    for (const auto& order : orders.Drain()) given = order;
    world_truth_t there{};
    there.x_m = 3;
    truth.Publish(there);
    pose_t believed{};
    believed.x_m = pose_x_m;
    pose.Publish(believed);
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
    Run(1.6);
  }
  bus::Publisher<mission_status_t> status = offboard_other.Advertise(channels::kMissionStatus);
  bus::Publisher<pose_t> pose = offboard_other.Advertise(channels::kPose);
  bus::Publisher<world_truth_t> truth = onboard_other.Advertise(channels::kWorldTruth);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
  mission_command_t given{};
};

TEST(LocateStory, OrdersItAndComparesThePoseWithTheTruth) {
  LocateStage stage;
  stage.RunTo(3.1, mission_result_t::DONE, "at (3.1, 0.0) 0 deg");
  EXPECT_EQ(stage.given.mission, mission_command_t::LOCATE);
  EXPECT_TRUE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "right: 0.10 m, 0.0 deg off; at (3.1, 0.0) 0 deg");
}

TEST(LocateStory, AWrongPlaceIsNoGoodEnd) {
  LocateStage stage;
  stage.RunTo(5, mission_result_t::DONE, "at (5.0, 0.0) 0 deg");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "wrong: 2.00 m, 0.0 deg off; at (5.0, 0.0) 0 deg");
}

TEST(LocateStory, AmbiguousIsSaidAsThePlannerSaysIt) {
  LocateStage stage;
  stage.RunTo(5, mission_result_t::FAILED, "ambiguous: 2 places");
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "ambiguous: 2 places");
}

TEST(LocateStory, AnyOtherFailureIsToldWithItsReason) {
  LocateStage stage;
  stage.RunTo(5, mission_result_t::FAILED, "the robot touched something");
  EXPECT_EQ(stage.story->Reason(), "failed: the robot touched something");
}

}  // namespace
}  // namespace priamos::cli
