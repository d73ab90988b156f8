#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bus/node.hpp"
#include "cli/scenario/alive_processes.hpp"
#include "cli/scenario/mission_order.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// The person at the workstation sends the robot from waypoint to waypoint. It has come to a good end when
/// the planner reports each as reached, and the base truly is near it (WORLD_TRUTH).
class GotoStory : public ScenarioStory {
 public:
  static constexpr std::string_view kName = "goto";
  static constexpr std::string_view kSummary = "the planner drives to places";
  static constexpr bool kMovesMouse = false;

  /// The stage's `progress` gets one line per order and per change of the mission.
  explicit GotoStory(const StoryStage& stage);

  void Tick(Time now) override;
  bool Done(Time now) const override;
  bool Started() const override { return order_.has_value(); }
  bool Succeeded() const override { return succeeded_; }
  bool DecidesTheRun() const override { return true; }
  std::string Reason() const override { return text_; }

 private:
  void Give(Time now);
  void Arrive(Time now);
  void End(Time now, bool succeeded, std::string text);

  Scenario scenario_;
  std::function<void(Time, const std::string&)> progress_;
  AliveProcesses alive_;
  bus::Inbox<mission_status_t> status_;
  bus::Latest<world_truth_t> truth_;
  bus::Publisher<mission_command_t> orders_;
  std::optional<MissionOrder> order_;
  std::size_t waypoint_ = 0;
  double worst_m_ = 0;  ///< largest true distance from a waypoint that was reached
  std::optional<Time> start_, ended_;
  bool succeeded_ = false;
  std::string text_ = "waits for the processes";
};

}  // namespace priamos::cli
