#include "cli/scenario/elevator_story.hpp"

#include <gmock/gmock.h>

#include "mission_stage.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

Scenario InAndOut() {
  Scenario scenario = ScenarioOf("elevator");
  scenario.waypoints = {{.x_m = 7, .y_m = 2, .yaw_deg = 0}, {.x_m = 4, .y_m = 2, .yaw_deg = 0}};
  return scenario;
}

/// The story, and a planner that reports what the test says.
struct ElevatorStage : MissionStage {
  ElevatorStage() : MissionStage(InAndOut()) { Begin(); }

  /// The base truly is at x; the planner reports `step` (0: the order) as ended.
  void Report(double x_m, int step, std::int8_t outcome = mission_result_t::DONE) {
    Stand(x_m, 2);
    said.order_id = given.order_id;
    said.title = given.title;
    mission_result_t result{};
    result.order_id = given.order_id;
    result.step = static_cast<std::int16_t>(step);
    result.outcome = outcome;
    result.text = "as said";
    said.results.push_back(result);
    said.n_results = static_cast<std::int8_t>(said.results.size());
    status.Publish(said);
    Run(0.5);
  }

  mission_status_t said{};
};

TEST(ElevatorStory, OrdersThreeStepsOnce) {
  ElevatorStage stage;
  ASSERT_EQ(stage.given.n_steps, 3);
  EXPECT_EQ(stage.given.rounds, 1);
  EXPECT_EQ(stage.given.steps[1].mission, mission_command_t::WAIT);
}

TEST(ElevatorStory, IsGoodWhenTheBaseWasInTheCabinAndIsOut) {
  ElevatorStage stage;
  stage.Report(7.1, 1);
  stage.Report(7.1, 2);
  stage.Report(4.1, 3);
  stage.Report(4.1, 0);
  EXPECT_TRUE(stage.story->Succeeded()) << stage.story->Reason();
}

TEST(ElevatorStory, ADoneOrderOfABaseThatIsElsewhereIsNone) {
  ElevatorStage before;
  before.Report(5, 2);
  EXPECT_FALSE(before.story->Succeeded());
  EXPECT_THAT(before.story->Reason(), HasSubstr("2.00 m from waypoint 1"));
  ElevatorStage inside;
  inside.Report(7, 2);
  inside.Report(7, 0);
  EXPECT_FALSE(inside.story->Succeeded());
  EXPECT_THAT(inside.story->Reason(), HasSubstr("from waypoint 2"));
}

TEST(ElevatorStory, SaysWhyTheOrderFailed) {
  ElevatorStage stage;
  stage.Report(5, 0, mission_result_t::FAILED);
  EXPECT_FALSE(stage.story->Succeeded());
  EXPECT_THAT(stage.story->Reason(), HasSubstr("as said"));
}

}  // namespace
}  // namespace priamos::cli
