#include "cli/scenario/explore_story.hpp"

#include <gmock/gmock.h>

#include "mission_stage.hpp"

namespace priamos::cli {
namespace {

struct FloorStage : MissionStage {
  FloorStage() : MissionStage(ScenarioOf("explore")) {}
  void RunTo(std::int8_t outcome, const std::string& text) {
    Begin();
    End(outcome, text);
  }
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
