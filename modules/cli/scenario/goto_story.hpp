#pragma once

#include <cstddef>
#include <string_view>

#include "cli/scenario/order_story.hpp"

namespace priamos::cli {

/// The person at the workstation sends the robot from waypoint to waypoint. It has come to a good end when
/// the planner reports each as reached, and the base truly is near it (WORLD_TRUTH).
class GotoStory : public OrderStory {
 public:
  static constexpr std::string_view kName = "goto";
  static constexpr std::string_view kSummary = "the planner drives to places";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = false;

  explicit GotoStory(const StoryStage& stage) : OrderStory(stage) {}

 private:
  void Begin(Time now) override { GiveNext(now); }
  void Follow(Time now) override;
  void GiveNext(Time now);
  void Arrive(Time now);

  std::size_t waypoint_ = 0;
  double worst_m_ = 0;  ///< largest true distance from a waypoint that was reached
};

}  // namespace priamos::cli
