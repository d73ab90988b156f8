#include "cli/scenario/corridor_story.hpp"

#include <gmock/gmock.h>

#include "mission_stage.hpp"

namespace priamos::cli {
namespace {

Scenario Corridor() {
  Scenario scenario = ScenarioOf("corridor");
  scenario.waypoints = {{.x_m = 20, .y_m = 0, .yaw_deg = 0}};
  return scenario;
}

struct CorridorStage : MissionStage {
  CorridorStage() : MissionStage(Corridor()) {}
  /// The order is given and taken, and its end is told with the base truly there.
  void RunTo(double x_m, std::int8_t outcome, const std::string& text) {
    Begin();
    Stand(x_m, 0.4);
    End(outcome, text);
  }
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
