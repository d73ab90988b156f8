#pragma once

#include <string>
#include <utility>

#include "stage.hpp"

namespace priamos::cli {

/// A scenario of one story, in which one process of the robot lives.
inline Scenario ScenarioOf(const std::string& story) {
  Scenario scenario;
  scenario.story = story;
  scenario.time_limit_s = 60;
  scenario.processes.resize(1);
  scenario.processes[0].module = "robot";
  scenario.processes[0].bus = "onboard";
  return scenario;
}

/// A story that gives one order, and the planner that takes it.
struct MissionStage : Stage {
  explicit MissionStage(Scenario of) : Stage(std::move(of)) {}

  /// The processes live, the order is given and taken.
  void Begin() {
    Live();
    status.Publish(mission_status_t{});
    Run(0.3);
    for (const auto& order : orders.Drain()) given = order;
  }
  /// The planner reports the order's end.
  void End(std::int8_t outcome, const std::string& text) {
    mission_status_t message{};
    message.order_id = given.order_id;
    mission_result_t result{};
    result.order_id = given.order_id;
    result.outcome = outcome;
    result.text = text;
    message.results = {result};
    message.n_results = 1;
    status.Publish(message);
    Run(0.2);
  }
  /// The true robot stands there.
  void Stand(double x_m, double y_m) {
    world_truth_t there{};
    there.x_m = x_m;
    there.y_m = y_m;
    truth.Publish(there);
    Run(0.1);
  }

  bus::Publisher<mission_status_t> status = offboard_other.Advertise(channels::kMissionStatus);
  bus::Publisher<world_truth_t> truth = onboard_other.Advertise(channels::kWorldTruth);
  bus::Inbox<mission_command_t> orders = offboard_other.SubscribeAll(channels::kMissionCommand);
  mission_command_t given{};
};

}  // namespace priamos::cli
