#pragma once

#include <functional>
#include <optional>
#include <string>

#include "bus/node.hpp"
#include "cli/scenario/alive_processes.hpp"
#include "cli/scenario/mission_order.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// A person at the workstation who gives orders that lead to the scenario's waypoints, once all processes are
/// alive. What is ordered, and what is a good end, is the derived story's.
class OrderStory : public ScenarioStory {
 public:
  static constexpr bool kNeedsPlanner = true, kNeedsWaypoints = true;

  void Tick(Time now) override;
  bool Done(Time now) const override;
  bool Started() const override { return order_.has_value(); }
  bool Succeeded() const override { return succeeded_; }
  bool DecidesTheRun() const override { return true; }
  std::string Reason() const override;

 protected:
  /// The stage's `progress` gets one line per order and per change of the mission.
  explicit OrderStory(const StoryStage& stage);

  /// All processes are alive: gives the first order.
  virtual void Begin(Time now) = 0;
  /// What the planner reports, after the order has heard it.
  virtual void Hear(const mission_status_t& /*status*/, Time /*now*/) {}
  /// Called at each tick while the story has not ended: looks at the order, and may give the next or End.
  virtual void Follow(Time now) = 0;

  /// Its number is drawn with the time: the same in each lockstep run.
  void Give(const mission_command_t& order) {
    order_.emplace(order, true, static_cast<std::uint32_t>(ToUtime(now_) / 1000));
  }
  void End(Time now, bool succeeded, std::string text);
  void Publish(const mission_command_t& command) { orders_.Publish(command); }
  void Report(Time now, const std::string& line) const { progress_(now, line); }
  const MissionOrder& order() const { return *order_; }
  const Scenario& scenario() const { return scenario_; }
  bool ended() const { return ended_.has_value(); }
  /// Newest WORLD_TRUTH; nullptr before the world reports.
  const world_truth_t* truth() const { return truth_.get(); }
  /// How far the base truly is from the waypoint (WORLD_TRUTH); nullopt before the world reports.
  std::optional<double> DistanceFrom(const ScenarioWaypoint& waypoint) const;

 private:
  Scenario scenario_;
  std::function<void(Time, const std::string&)> progress_;
  AliveProcesses alive_;
  bus::Inbox<mission_status_t> status_;
  bus::Latest<world_truth_t> truth_;
  bus::Publisher<mission_command_t> orders_;
  std::optional<MissionOrder> order_;
  std::optional<Time> start_, ended_;
  Time now_{};
  bool succeeded_ = false;
  std::string text_ = "waits for the processes";
};

/// The base may truly be so far from where it was sent: the mission's tolerance and the paper's 20 cm of a
/// pose that needs no correction; and a world's map is wrong by 10 cm and 3 degrees, 16 cm at 3 m from the
/// door.
constexpr double kNearWaypoint_m = 0.45;

}  // namespace priamos::cli
