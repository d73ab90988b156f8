#pragma once

#include <string_view>

#include "cli/scenario/order_story.hpp"

namespace priamos::cli {

/// The robot was carried somewhere, and its pose is wrong by metres; the person at the workstation has it
/// find out where it is. It has come to a good end when it says that it knows, and is right (WORLD_TRUTH).
/// Its last words begin with "right", "wrong", "ambiguous" or what else came of it.
class LocateStory : public OrderStory {
 public:
  static constexpr std::string_view kName = "locate";
  static constexpr std::string_view kSummary = "a robot that was carried finds out where it is";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = false;
  static constexpr bool kNeedsWaypoints = false;

  explicit LocateStory(const StoryStage& stage)
      : OrderStory(stage), pose_(stage.offboard.Subscribe(channels::kPose)) {}

 private:
  void Begin(Time now) override;
  void Follow(Time now) override;
  void Judge(Time now);

  bus::Latest<pose_t> pose_;
  std::optional<Time> found_;
};

}  // namespace priamos::cli
