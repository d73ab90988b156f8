#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "cli/scenario/order_story.hpp"

namespace priamos::cli {

/// The person at the workstation gives one order: all waypoints in turn, round after round; pauses it once in
/// the first round, and cancels it when two rounds are done. It has come to a good end when the base truly
/// was near each waypoint (WORLD_TRUTH) as the planner reported it, and the order ended as cancelled.
class PatrolStory : public OrderStory {
 public:
  static constexpr std::string_view kName = "patrol";
  static constexpr std::string_view kSummary = "the planner drives to places, round after round";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = false;

  explicit PatrolStory(const StoryStage& stage)
      : OrderStory(stage),
        paths_(stage.offboard.SubscribeAll(channels::kPath)),
        drives_(stage.offboard.SubscribeAll(channels::kDriveStatus)) {}

 private:
  void Begin(Time now) override;
  void Hear(const mission_status_t& status, Time now) override;
  void Follow(Time now) override;
  void CheckPlaces(Time now);
  void Intervene(Time now);
  void Conclude(Time now);

  bus::Inbox<path_t> paths_;
  bus::Inbox<drive_status_t> drives_;
  std::optional<MissionOrder> intervention_;
  std::size_t n_interventions_ = 0;  ///< done: pause, resume, cancel
  std::size_t n_results_ = 0;        ///< of steps, looked at
  std::size_t n_places_ = 0;         ///< reached
  double worst_m_ = 0;               ///< largest true distance from a waypoint that was reached
  std::optional<Time> paused_;
};

}  // namespace priamos::cli
