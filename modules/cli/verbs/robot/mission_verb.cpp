#include "cli/verbs/robot/mission_verb.hpp"

#include <fmt/format.h>

#include <iostream>
#include <random>

#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/supervise/live_deployment.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

/// What a person reads meanwhile; standard output belongs to the JSON.
std::ostream& People(const MissionOptions& options) {
  return options.json ? std::cerr : std::cout;
}

void PrintStep(const MissionOptions& options, const mission_result_t& step) {
  const std::string outcome(ResultName(step.outcome));
  People(options) << fmt::format("step {} {} after {:.0f} s: {}", step.step, outcome, step.took_s, step.text)
                  << std::endl;
  if (options.json)
    std::cout << JsonLine({{"order", std::int64_t(step.order_id)},
                           {"step", std::int64_t(step.step)},
                           {"round", std::int64_t(step.round)},
                           {"outcome", outcome},
                           {"took_s", step.took_s},
                           {"text", step.text}})
              << std::endl;
}

/// Prints how it ended. Returns the exit code.
int Conclude(const MissionOptions& options, const MissionOrder& order, const char* verb) {
  const OrderOutcome outcome = order.outcome();
  if (options.json)
    std::cout << JsonLine({{"order", verb},
                           {"id", std::int64_t(order.id())},
                           {"outcome", std::string(Text(outcome))},
                           {"text", order.text()}})
              << "\n";
  if (outcome == OrderOutcome::kDone || outcome == OrderOutcome::kAccepted) {
    People(options) << fmt::format("{}: {}\n", Text(outcome), order.text());
    return 0;
  }
  std::cerr << fmt::format("priamos mission {}: {}: {}\n", verb,
                           outcome == OrderOutcome::kOpen ? "interrupted" : Text(outcome), order.text());
  return kMissionNotDone;
}

}  // namespace

int GiveOrder(const MissionOptions& options, const mission_command_t& command, const char* verb) {
  BusSession session(fmt::format("priamos mission {}", verb), options.bus, channels::kMissionStatus.name);
  auto statuses = session.node().SubscribeAll(channels::kMissionStatus);
  auto paths = session.node().SubscribeAll(channels::kPath);
  auto drives = session.node().SubscribeAll(channels::kDriveStatus);
  auto orders = session.node().Advertise(channels::kMissionCommand);
  MissionOrder order(command, options.wait, std::random_device{}());
  std::size_t n_steps = 0;
  const auto step = [&] {
    const Time now = session.now();
    for (const path_t& path : paths.Drain()) order.Hear(path);
    for (const drive_status_t& drive : drives.Drain()) order.Hear(drive, now);
    for (const mission_status_t& status : statuses.Drain()) {
      session.Heard();
      const auto text = order.Hear(status, now);
      for (; n_steps < order.steps().size(); ++n_steps) PrintStep(options, order.steps()[n_steps]);
      if (text && order.outcome() == OrderOutcome::kOpen) People(options) << *text << std::endl;
    }
    if (const auto message = order.Step(now)) orders.Publish(*message);
  };
  session.Watch(
      Time::max(), [&] { return order.outcome() != OrderOutcome::kOpen; }, step);
  return Conclude(options, order, verb);
}

ConfigSource PlannerOf(const MissionOptions& options) {
  if (!options.deployment.empty()) return PlannerInUse(options.deployment, "");
  const bus::BusChoice& bus = options.bus.bus;
  return PlannerInUse("", LogRootInUse(LogRoot(options.log_root), bus.robot, bus.network));
}

void AddPlannerOptions(CLI::App& verb, MissionOptions& options) {
  AddLiveDeploymentOption(verb, options.deployment);
  AddLogsOption(verb, options.log_root, "of the deployment that is up");
}

void CompleteMission(CLI::App& verb, const std::shared_ptr<MissionOptions>& options,
                     int (*run)(const MissionOptions&), int& exit_code) {
  AddBusOption(verb, options->bus);
  CompleteVerb(verb, options, run, exit_code, "the outcome machine-readable");
}

std::string_view ResultName(int outcome) {
  constexpr std::string_view kNames[] = {"done", "failed", "cancelled", "refused"};
  return outcome >= 0 && outcome < 4 ? kNames[outcome] : "unknown";
}

std::string ProgressText(const mission_status_t& status) {
  if (!status.running) return "";
  std::string text;
  if (status.n_steps > 1) text += fmt::format(", step {} of {}", status.step, status.n_steps);
  if (status.rounds != 1) text += fmt::format(", round {}", status.round);
  if (status.left_s >= 0) text += fmt::format(", {:.0f} s left", status.left_s);
  return text + (status.paused ? ", paused" : "");
}

std::vector<std::pair<std::string, JsonScalar>> StatusMembers(const mission_status_t& status) {
  return {{"phase", std::string(PhaseName(status.phase))},
          {"text", status.text},
          {"order", std::int64_t(status.order_id)},
          {"title", status.title},
          {"running", status.running != 0},
          {"paused", status.paused != 0},
          {"step", std::int64_t(status.step)},
          {"n_steps", std::int64_t(status.n_steps)},
          {"round", std::int64_t(status.round)},
          {"left_s", status.left_s >= 0 ? JsonScalar(status.left_s) : JsonScalar(nullptr)},
          {"n_waiting", std::int64_t(status.n_waiting)}};
}

}  // namespace priamos::cli
