#include "cli/scenario/locate_story.hpp"

#include <gmock/gmock.h>

#include "mission_stage.hpp"

namespace priamos::cli {
namespace {

struct LocateStage : MissionStage {
  LocateStage() : MissionStage(ScenarioOf("locate")) {}
  /// The order is given and taken; its end is told with the base truly at x 3 m.
  void RunTo(double pose_x_m, std::int8_t outcome, const std::string& text) {
    Begin();
    pose_t believed{};
    believed.x_m = pose_x_m;
    pose.Publish(believed);
    Stand(3, 0);
    End(outcome, text);
    Run(1.4);
  }
  bus::Publisher<pose_t> pose = offboard_other.Advertise(channels::kPose);
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
