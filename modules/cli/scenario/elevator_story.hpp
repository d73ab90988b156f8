#pragma once

#include <cstddef>
#include <string_view>

#include "cli/scenario/order_story.hpp"

namespace priamos::cli {

/// The person at the workstation has the robot drive into a cabin, ride, and come out again, in one order. It
/// has come to a good end when the base truly was near the first waypoint (WORLD_TRUTH) as it had come in,
/// and near the second one as it was out.
class ElevatorStory : public OrderStory {
 public:
  static constexpr std::string_view kName = "elevator";
  static constexpr std::string_view kSummary = "the planner drives into a cabin and out again";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = true;

  explicit ElevatorStory(const StoryStage& stage) : OrderStory(stage) {}

 private:
  void Begin(Time now) override;
  void Follow(Time now) override;
  bool IsAt(std::size_t waypoint, Time now);

  bool inside_ = false;  ///< it was
};

}  // namespace priamos::cli
