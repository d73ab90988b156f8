#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <optional>

#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/scenario/door_name.hpp"
#include "cli/scenario/mission_order.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "common/geometry.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kNotDone = 1;

struct MissionOptions {
  BusOptions bus;
  std::string door;
  double x_m = 0, y_m = 0;
  std::optional<double> yaw_deg;
  std::string deployment = "sim";
  bool wait = false, json = false;
};

/// What a person reads meanwhile; standard output belongs to the JSON.
std::ostream& People(const MissionOptions& options) {
  return options.json ? std::cerr : std::cout;
}

/// Gives the order and follows it as long as it is open. Returns the exit code.
int Give(const MissionOptions& options, const mission_command_t& command, const char* verb) {
  BusSession session(fmt::format("priamos mission {}", verb), options.bus, channels::kMissionStatus.name);
  auto statuses = session.node().SubscribeAll(channels::kMissionStatus);
  auto orders = session.node().Advertise(channels::kMissionCommand);
  MissionOrder order(command, options.wait);
  const auto step = [&] {
    const Time now = session.now();
    for (const mission_status_t& status : statuses.Drain()) {
      session.Heard();
      const auto text = order.Hear(status, now);
      if (text && order.outcome() == OrderOutcome::kOpen) People(options) << *text << std::endl;
    }
    if (const auto message = order.Step(now)) orders.Publish(*message);
  };
  session.Watch(
      Time::max(), [&] { return order.outcome() != OrderOutcome::kOpen; }, step);
  const OrderOutcome outcome = order.outcome();
  if (options.json)
    std::cout << JsonLine({{"order", verb}, {"outcome", std::string(Text(outcome))}, {"text", order.text()}})
              << "\n";
  if (outcome == OrderOutcome::kDone || outcome == OrderOutcome::kAccepted) {
    People(options) << fmt::format("{}: {}\n", Text(outcome), order.text());
    return 0;
  }
  std::cerr << fmt::format("priamos mission {}: {}: {}\n", verb,
                           outcome == OrderOutcome::kOpen ? "interrupted" : Text(outcome), order.text());
  return kNotDone;
}

int PassDoor(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::PASS_DOOR;
  command.landmark_id =
      static_cast<std::int16_t>(DoorOfDeployment(FolderOfDeployment(options.deployment), options.door));
  return Give(options, command, "door");
}

int GoTo(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::GOTO;
  command.x_m = options.x_m;
  command.y_m = options.y_m;
  command.turn = options.yaw_deg.has_value();
  command.yaw_rad = WrapAngle(Radians(options.yaw_deg.value_or(0)));
  return Give(options, command, "goto");
}

int Abort(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::ABORT;
  return Give(options, command, "abort");
}

void Print(const MissionOptions& options, const mission_status_t& status) {
  if (options.json)
    std::cout << JsonLine({{"phase", std::string(PhaseName(status.phase))}, {"text", status.text}})
              << std::endl;
  else
    std::cout << fmt::format("{}: {}", PhaseName(status.phase), status.text) << std::endl;
}

/// Prints the planner's answer; with --wait until the mission is over. 1 when it failed or nobody answers.
int Status(const MissionOptions& options) {
  constexpr Duration kSpeaksWithin = std::chrono::seconds(2);
  BusSession session("priamos mission status", options.bus, channels::kMissionStatus.name);
  auto statuses = session.node().SubscribeAll(channels::kMissionStatus);
  std::optional<mission_status_t> last;
  Time heard = session.now();
  const auto step = [&] {
    for (const mission_status_t& status : statuses.Drain()) {
      session.Heard();
      heard = session.now();
      if (!last || last->text != status.text || last->phase != status.phase) Print(options, status);
      last = status;
    }
  };
  const auto over = [&] {
    if (session.now() - heard > kSpeaksWithin) return true;
    return last && (!options.wait || IsOver(*last));
  };
  session.Watch(Time::max(), over, step);
  if (!last && options.json) std::cout << JsonLine({{"phase", nullptr}}) << "\n";
  const bool good = last && last->phase != mission_status_t::FAILED && (!options.wait || IsOver(*last));
  return good ? 0 : kNotDone;
}

using Run = int (*)(const MissionOptions&);

/// The options that every mission has.
void Complete(CLI::App& verb, const std::shared_ptr<MissionOptions>& options, Run run, int& exit_code) {
  AddBusOption(verb, options->bus);
  CompleteVerb(verb, options, run, exit_code, "the outcome machine-readable");
}

// Each verb has options of its own: CLI11 fills in what $PRIAMOS_BUS says for every verb that was not typed,
// and would overwrite the --bus of the one that was.

void AddDoorVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(
      mission, "door",
      "Pass a door; ends when the robot is under way, with --wait when it is through (exit code 1: not).");
  verb->footer("Example: priamos mission door laboratory --wait");
  verb->add_option("door", options->door, "its name in the map, or its number")->required();
  verb->add_flag("--wait", options->wait, "until the mission is over");
  AddDeploymentOption(*verb, options->deployment);
  Complete(*verb, options, PassDoor, exit_code);
}

void AddGotoVerb(CLI::App& mission, int& exit_code) {
  constexpr double kFarthest_m = 100, kTurn_deg = 360;
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(
      mission, "goto",
      "Drive to a place; ends when the robot is under way, with --wait when it is there (exit code 1: not).");
  verb->footer("Example: priamos mission goto 4.5 1.2 --yaw 90 --wait");
  verb->add_option("x", options->x_m, "[m] map frame")
      ->required()
      ->check(CLI::Range(-kFarthest_m, kFarthest_m));
  verb->add_option("y", options->y_m, "[m] map frame")
      ->required()
      ->check(CLI::Range(-kFarthest_m, kFarthest_m));
  verb->add_option("--yaw", options->yaw_deg,
                   "[deg] heading to have there; as it suits the path if not given")
      ->check(CLI::Range(-kTurn_deg, kTurn_deg));
  verb->add_flag("--wait", options->wait, "until the mission is over");
  Complete(*verb, options, GoTo, exit_code);
}

void AddAbortVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "abort", "End the mission that is under way; the robot brakes.");
  verb->footer("Example: priamos mission abort");
  Complete(*verb, options, Abort, exit_code);
}

void AddStatusVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "status", "What the planner does (exit code 1: it failed or is silent).");
  verb->footer("Example: priamos mission status --wait");
  verb->add_flag("--wait", options->wait, "follow it until it is over");
  Complete(*verb, options, Status, exit_code);
}

}  // namespace

void AddMissionCommand(CLI::App& cli, int& exit_code) {
  auto* mission = AddVerb(cli, "mission", "Order the planner, and ask how its mission stands.");
  mission->require_subcommand(1);
  AddDoorVerb(*mission, exit_code);
  AddGotoVerb(*mission, exit_code);
  AddAbortVerb(*mission, exit_code);
  AddStatusVerb(*mission, exit_code);
}

}  // namespace priamos::cli
