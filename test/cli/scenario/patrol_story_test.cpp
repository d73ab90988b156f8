#include "cli/scenario/patrol_story.hpp"

#include <gmock/gmock.h>

#include "mission_stage.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

Scenario TwoPlaces() {
  Scenario scenario = ScenarioOf("patrol");
  scenario.time_limit_s = 600;
  scenario.waypoints = {{.x_m = 4, .y_m = 1, .yaw_deg = 90}, {.x_m = 2, .y_m = 2, .yaw_deg = 0}};
  return scenario;
}

/// The story, and a planner and a robot that do what they are told, a place a second.
struct PatrolStage : Stage {
  PatrolStage() : Stage(TwoPlaces()) { Live(); }

  void Second() {
    for (const auto& order : orders.Drain()) Take(order);
    if (status.running && !status.paused && !stuck) {
      const ScenarioWaypoint& at = scenario.waypoints[n_places % 2];
      world_truth_t here{};
      here.x_m = at.x_m + off_m;
      here.y_m = at.y_m;
      truth.Publish(here);
      Run(0.1);
      Add(int(n_places % 2) + 1, mission_result_t::DONE, "there");
      ++n_places;
    }
    said.Publish(status);
    Run(0.5);
    drive_status_t stands{};
    stands.mode = drive_status_t::HOLDING;
    drive.Publish(stands);
    Run(0.5);
  }
  void Take(const mission_command_t& order) {
    kinds.push_back(order.mission);
    if (order.mission == mission_command_t::RUN) {
      status.running = true;
      status.order_id = order.order_id;
      status.title = order.title;
    }
    if (order.mission == mission_command_t::PAUSE) {
      status.paused = true;
      path.Publish(path_t{});
    }
    if (order.mission == mission_command_t::RESUME) status.paused = false;
    if (order.mission != mission_command_t::CANCEL) return;
    status.running = false;
    Add(0, mission_result_t::CANCELLED, "cancelled by the operator");
  }
  void Add(int step, std::int8_t outcome, const std::string& text) {
    mission_result_t result{};
    result.order_id = status.order_id;
    result.step = static_cast<std::int16_t>(step);
    result.round = static_cast<std::int16_t>(n_places / 2 + 1);
    result.outcome = outcome;
    result.text = text;
    status.results.push_back(result);
    status.n_results = static_cast<std::int8_t>(status.results.size());
  }

  double off_m = 0.1;
  bool stuck = false;
  std::size_t n_places = 0;
  mission_status_t status{};
  std::vector<int> kinds;  ///< of the orders, in turn
  bus::Publisher<mission_status_t> said = offboard_other.Advertise(channels::kMissionStatus);
  bus::Publisher<world_truth_t> truth = onboard_other.Advertise(channels::kWorldTruth);
  bus::Publisher<path_t> path = offboard_other.Advertise(channels::kPath);
  bus::Publisher<drive_status_t> drive = offboard_other.Advertise(channels::kDriveStatus);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
};

TEST(PatrolStory, PausesResumesAndCancelsAfterTwoRounds) {
  PatrolStage stage;
  for (int i = 0; i < 40 && !stage.Done(); ++i) stage.Second();
  EXPECT_TRUE(stage.story->Succeeded()) << stage.story->Reason();
  EXPECT_THAT(stage.story->Reason(), HasSubstr("in 2 rounds, 0.10 m off at most"));
  EXPECT_THAT(stage.kinds, testing::ElementsAre(mission_command_t::RUN, mission_command_t::PAUSE,
                                                mission_command_t::RESUME, mission_command_t::CANCEL));
}

TEST(PatrolStory, ARobotThatIsElsewhereHasNotSucceeded) {
  PatrolStage stage;
  stage.off_m = 0.6;
  for (int i = 0; i < 10; ++i) stage.Second();
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "round 1: the base is 0.60 m from waypoint 1");
}

TEST(PatrolStory, AnOrderThatFailsEndsItWithTheReason) {
  PatrolStage stage;
  stage.stuck = true;
  for (int i = 0; i < 4; ++i) stage.Second();
  stage.status.running = false;
  stage.Add(0, mission_result_t::FAILED, "no way");
  for (int i = 0; i < 4; ++i) stage.Second();
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_EQ(stage.story->Reason(), "after 0 places: failed: no way");
}

}  // namespace
}  // namespace priamos::cli
