#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bus/node.hpp"
#include "cli/scenario/alive_processes.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// What a person reads of the answer to a look.
std::string LookText(const landmark_fix_t& look);

/// The person at the workstation: waits until every process is alive, gives the order, and watches the
/// mission status on the offboard bus.
class DoorStory : public ScenarioStory {
 public:
  static constexpr std::string_view kName = "door";
  static constexpr std::string_view kSummary = "the planner passes it";
  static constexpr bool kMovesMouse = false;
  static constexpr bool kSeeksDoor = true;
  static constexpr bool kNeedsPlanner = true, kNeedsWaypoints = false;

  /// The stage's `progress` gets one line per phase and per look.
  explicit DoorStory(const StoryStage& stage);

  void Tick(Time now) override;
  bool Done(Time now) const override;
  bool Started() const override { return ordered_.has_value(); }
  /// True when the planner reported success.
  bool Succeeded() const override { return succeeded_; }
  /// The last words of the mission; what is missing while it has not begun.
  std::string Reason() const override;

 private:
  void GiveOrder(Time now);
  void FollowMission(Time now);
  void FollowLooks(Time now);

  Scenario scenario_;
  std::function<void(Time, const std::string&)> progress_;
  AliveProcesses alive_;
  bus::Inbox<mission_status_t> status_;
  bus::Inbox<landmark_fix_t> looks_;
  bus::Publisher<mission_command_t> order_;
  std::optional<Time> start_, ordered_, ended_;
  std::int32_t order_id_ = 0;
  std::int8_t phase_ = -1;
  bool succeeded_ = false;
  std::string text_;
};

}  // namespace priamos::cli
