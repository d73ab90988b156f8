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

/// The person at the workstation gives one order: all waypoints in turn, round after round; pauses it once in
/// the first round, and cancels it when two rounds are done. It has come to a good end when the base truly
/// was near each waypoint (WORLD_TRUTH) as the planner reported it, and the order ended as cancelled.
class PatrolStory : public ScenarioStory {
 public:
  static constexpr std::string_view kName = "patrol";
  static constexpr std::string_view kSummary = "the planner drives to places, round after round";
  static constexpr bool kMovesMouse = false;

  explicit PatrolStory(const StoryStage& stage);

  void Tick(Time now) override;
  bool Done(Time now) const override;
  bool Started() const override { return order_.has_value(); }
  bool Succeeded() const override { return succeeded_; }
  bool DecidesTheRun() const override { return true; }
  std::string Reason() const override { return text_; }

 private:
  void Give();
  void Hear(Time now);
  void CheckPlaces(Time now);
  void Intervene(Time now);
  void Conclude(Time now);
  void End(Time now, bool succeeded, std::string text);

  Scenario scenario_;
  std::function<void(Time, const std::string&)> progress_;
  AliveProcesses alive_;
  bus::Inbox<mission_status_t> status_;
  bus::Latest<world_truth_t> truth_;
  bus::Publisher<mission_command_t> orders_;
  std::optional<MissionOrder> order_, intervention_;
  std::size_t n_interventions_ = 0;  ///< done: pause, resume, cancel
  std::size_t n_results_ = 0;        ///< of steps, looked at
  std::size_t n_places_ = 0;         ///< reached
  double worst_m_ = 0;               ///< largest true distance from a waypoint that was reached
  std::optional<Time> start_, ended_, paused_;
  bool succeeded_ = false;
  std::string text_ = "waits for the processes";
};

}  // namespace priamos::cli
