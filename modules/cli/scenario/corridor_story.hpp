#pragma once

#include <string_view>

#include "cli/scenario/order_story.hpp"

namespace priamos::cli {

/// The person at the workstation has the robot follow the corridor in which it stands to its end, where the
/// first waypoint is. It has come to a good end when the planner reports it, and the base truly is there
/// (WORLD_TRUTH).
class CorridorStory : public OrderStory {
 public:
  static constexpr std::string_view kName = "corridor";
  static constexpr std::string_view kSummary = "the planner has a corridor followed to its end";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = false;

  explicit CorridorStory(const StoryStage& stage) : OrderStory(stage) {}

 private:
  void Begin(Time now) override;
  void Follow(Time now) override;
};

}  // namespace priamos::cli
