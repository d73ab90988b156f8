#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>

#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/scenario/mission_file.hpp"
#include "cli/verbs/robot/mission_verb.hpp"
#include "common/archive.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

int RunFile(const MissionOptions& options) {
  return GiveOrder(options, OrderOfFile(options.file, PlannerOf(options)), "run");
}

int Patrol(const MissionOptions& options) {
  constexpr std::size_t kMostPlaces = 32;
  const std::size_t n = options.places.size() / 2;
  if (options.places.size() % 2 != 0)
    throw ConfigError(fmt::format("expected x and y of each place, got {} numbers", options.places.size()));
  if (n > kMostPlaces) throw ConfigError(fmt::format("expected at most {} places, got {}", kMostPlaces, n));
  if (n < 1) throw ConfigError("expected x and y of one place or more, got none");
  MissionFile patrol;
  patrol.title = fmt::format("patrol of {} places", n);
  patrol.rounds = 0;
  for (std::size_t i = 0; i < n; ++i) {
    MissionFileStep step;
    step.x_m = options.places[2 * i];
    step.y_m = options.places[2 * i + 1];
    step.place = SectionPlace("", fmt::format("place {}: ", i + 1), {});
    patrol.steps.push_back(step);
  }
  return GiveOrder(options, OrderOf(patrol, PlannerOf(options)), "patrol");
}

int Elevator(const MissionOptions& options) {
  MissionFile file;
  file.title = fmt::format("elevator {}", options.door).substr(0, 60);
  MissionFileStep ride;
  ride.what = "elevator";
  ride.door = options.door;
  ride.wait_s = options.wait_s;
  ride.turn = options.turn;
  file.steps.push_back(ride);
  return GiveOrder(options, OrderOf(file, PlannerOf(options)), "elevator");
}

int Intervene(const MissionOptions& options, std::int8_t mission, const char* verb) {
  mission_command_t command{};
  command.mission = mission;
  command.order_id = options.order;
  return GiveOrder(options, command, verb);
}

int Pause(const MissionOptions& options) {
  return Intervene(options, mission_command_t::PAUSE, "pause");
}
int Resume(const MissionOptions& options) {
  return Intervene(options, mission_command_t::RESUME, "resume");
}
int Cancel(const MissionOptions& options) {
  return Intervene(options, mission_command_t::CANCEL, "cancel");
}

/// One line per order: the one under way, those that wait, how the last ones ended.
void PrintList(const mission_status_t& status) {
  if (status.running)
    std::cout << fmt::format("{:>5}  {:<9}  {}: {}{}\n", status.order_id,
                             status.paused ? "paused" : "under way", status.title, status.text,
                             ProgressText(status));
  for (const mission_waiting_t& waits : status.waiting)
    std::cout << fmt::format("{:>5}  {:<9}  {}\n", waits.order_id, "waits", waits.title);
  for (const mission_result_t& result : status.results)
    if (result.step == 0)
      std::cout << fmt::format("{:>5}  {:<9}  {} ({:.0f} s)\n", result.order_id, ResultName(result.outcome),
                               result.text, result.took_s);
  if (!status.running && status.waiting.empty() && status.results.empty()) std::cout << "no order yet\n";
}

void PrintListAsJson(const mission_status_t& status) {
  if (status.running) std::cout << JsonLine(StatusMembers(status)) << "\n";
  for (const mission_waiting_t& waits : status.waiting)
    std::cout << JsonLine(
                     {{"order", std::int64_t(waits.order_id)}, {"outcome", "waits"}, {"title", waits.title}})
              << "\n";
  for (const mission_result_t& result : status.results)
    std::cout << JsonLine({{"order", std::int64_t(result.order_id)},
                           {"step", std::int64_t(result.step)},
                           {"round", std::int64_t(result.round)},
                           {"outcome", std::string(ResultName(result.outcome))},
                           {"took_s", result.took_s},
                           {"text", result.text}})
              << "\n";
}

int List(const MissionOptions& options) {
  constexpr Duration kSpeaksWithin = std::chrono::seconds(2);
  BusSession session("priamos mission list", options.bus, channels::kMissionStatus.name);
  auto statuses = session.node().SubscribeAll(channels::kMissionStatus);
  std::optional<mission_status_t> heard;
  session.Watch(
      session.now() + kSpeaksWithin, [&] { return heard.has_value(); },
      [&] {
        for (mission_status_t& status : statuses.Drain()) {
          session.Heard();
          heard = std::move(status);
        }
      });
  if (!heard) {
    if (options.json) std::cout << JsonLine({{"order", nullptr}}) << "\n";
    return kMissionNotDone;
  }
  options.json ? PrintListAsJson(*heard) : PrintList(*heard);
  return 0;
}

void AddRunVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb =
      AddVerb(mission, "run",
              "Order the steps of a file, which is checked before anything moves; ends when they are under "
              "way or wait, with --wait when they are over (exit code 1: not done).");
  verb->footer("Example: priamos mission run config/sim/missions/round.toml --wait");
  verb->add_option("file", options->file,
                   "TOML: [[step]] with do = goto, door, elevator, corridor, explore, locate, wait or repeat")
      ->required();
  verb->add_flag("--wait", options->wait, "until they are over");
  AddPlannerOptions(*verb, *options);
  CompleteMission(*verb, options, RunFile, exit_code);
}

void AddPatrolVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(
      mission, "patrol",
      "Drive to places in turn, round after round, until it is cancelled; the places, and the ways between "
      "them, are checked before anything moves.");
  verb->footer("Example: priamos mission patrol 4.7 1.3 2.0 2.4");
  verb->add_option("places", options->places, "[m] map frame: x and y of each place")
      ->required()
      ->check(CLI::Range(-100.0, 100.0));
  verb->add_flag("--wait", options->wait, "until it is over");
  AddPlannerOptions(*verb, *options);
  CompleteMission(*verb, options, Patrol, exit_code);
}

void AddElevatorVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  options->wait_s = 10;
  auto* verb = AddVerb(mission, "elevator",
                       "Into the cabin behind a door, stand while it rides, and out again, backwards unless "
                       "it turned; whether base and cabin fit is checked before anything moves.");
  verb->footer("Example: priamos mission elevator cabin --ride 20 --wait");
  verb->add_option("door", options->door, "the cabin's door: its name in the map, or its number")->required();
  verb->add_option("--ride", options->wait_s, "[s] how long it stands in the cabin; 10 if not given")
      ->check(CLI::Range(0.0, 36000.0));
  verb->add_flag("--turn", options->turn,
                 "turn round in the cabin: it has to hold the circle around the base");
  verb->add_flag("--wait", options->wait, "until it is out again");
  AddPlannerOptions(*verb, *options);
  CompleteMission(*verb, options, Elevator, exit_code);
}

void AddCancelVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "cancel", "End or take back one order; the next one begins.");
  verb->footer("Example: priamos mission cancel 4711");
  verb->add_option("order", options->order, "its number, which `priamos mission list` shows")
      ->required()
      ->check(CLI::Range(1, 65535));
  CompleteMission(*verb, options, Cancel, exit_code);
}

void AddPlainVerb(CLI::App& mission, const char* name, const char* what, int (*run)(const MissionOptions&),
                  int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, name, what);
  verb->footer(fmt::format("Example: priamos mission {}", name));
  CompleteMission(*verb, options, run, exit_code);
}

}  // namespace

void AddQueueVerbs(CLI::App& mission, int& exit_code) {
  AddRunVerb(mission, exit_code);
  AddPatrolVerb(mission, exit_code);
  AddElevatorVerb(mission, exit_code);
  AddPlainVerb(mission, "list", "The order under way, those that wait, and how the last ones ended.", List,
               exit_code);
  AddCancelVerb(mission, exit_code);
  AddPlainVerb(mission, "pause", "The robot brakes and holds its place, until `priamos mission resume`.",
               Pause, exit_code);
  AddPlainVerb(mission, "resume", "A paused mission goes on.", Resume, exit_code);
}

}  // namespace priamos::cli
