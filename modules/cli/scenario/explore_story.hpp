#pragma once

#include <string_view>

#include "cli/scenario/order_story.hpp"

namespace priamos::cli {

/// The person at the workstation has the robot explore a floor of which there is no plan. It has come to a
/// good end when the planner reports it; how much of the floor was seen is judged by the verdict of the run.
class ExploreStory : public OrderStory {
 public:
  static constexpr std::string_view kName = "explore";
  static constexpr std::string_view kSummary = "the planner has an unknown floor explored";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = false;
  static constexpr bool kNeedsWaypoints = false;

  explicit ExploreStory(const StoryStage& stage) : OrderStory(stage) {}

 private:
  void Begin(Time now) override;
  void Follow(Time now) override;
};

}  // namespace priamos::cli
