#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <optional>

#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/scenario/door_name.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "cli/verbs/robot/mission_verb.hpp"
#include "common/geometry.hpp"
#include "common/robot/mission_titles.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

int PassDoor(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::PASS_DOOR;
  command.landmark_id = static_cast<std::int16_t>(DoorOfPlanner(PlannerOf(options), options.door));
  // As the planner calls it; of a number only the planner knows the name.
  const bool named = options.door.find_first_not_of("0123456789") != std::string::npos;
  if (named) command.title = DoorTitle(options.door).substr(0, 60);
  return GiveOrder(options, command, "door");
}

/// The heading at the goal, or the direction of the corridor.
void SetHeading(const MissionOptions& options, mission_command_t& command) {
  command.turn = options.yaw_deg.has_value();
  command.yaw_rad = WrapAngle(Radians(options.yaw_deg.value_or(0)));
}

int GoTo(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::GOTO;
  command.x_m = options.x_m;
  command.y_m = options.y_m;
  command.title = GotoTitle(options.x_m, options.y_m);
  SetHeading(options, command);
  return GiveOrder(options, command, "goto");
}

int FollowCorridor(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::CORRIDOR;
  command.distance_m = static_cast<float>(options.distance_m);
  command.title = CorridorTitle(options.distance_m);
  SetHeading(options, command);
  return GiveOrder(options, command, "corridor");
}

/// An order that says nothing more than what it is.
int OrderMission(const MissionOptions& options, std::int8_t mission, std::string_view title,
                 const char* verb) {
  mission_command_t command{};
  command.mission = mission;
  command.title = title;
  return GiveOrder(options, command, verb);
}

int Explore(const MissionOptions& options) {
  return OrderMission(options, mission_command_t::EXPLORE, kExploreTitle, "explore");
}

int Locate(const MissionOptions& options) {
  return OrderMission(options, mission_command_t::LOCATE, kLocateTitle, "locate");
}

int Abort(const MissionOptions& options) {
  mission_command_t command{};
  command.mission = mission_command_t::ABORT;
  return GiveOrder(options, command, "abort");
}

void Print(const MissionOptions& options, const mission_status_t& status) {
  if (options.json)
    std::cout << JsonLine(StatusMembers(status)) << std::endl;
  else
    std::cout << fmt::format("{}: {}{}", PhaseName(status.phase), status.text, ProgressText(status))
              << std::endl;
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
      if (!last || last->text != status.text || last->phase != status.phase || last->step != status.step)
        Print(options, status);
      last = status;
    }
  };
  const auto over = [&] {
    if (session.now() - heard > kSpeaksWithin) return true;
    return last && (!options.wait || (IsOver(*last) && !last->running));
  };
  session.Watch(Time::max(), over, step);
  if (!last && options.json) std::cout << JsonLine({{"phase", nullptr}}) << "\n";
  const bool good = last && last->phase != mission_status_t::FAILED && (!options.wait || IsOver(*last));
  return good ? 0 : kMissionNotDone;
}

// Each verb has options of its own: CLI11 fills in what $PRIAMOS_BUS says for every verb that was not typed,
// and would overwrite the --bus of the one that was.

void AddDoorVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "door",
                       "Pass a door from the side where the robot is; ends when the robot is under way, with "
                       "--wait when it is through (exit code 1: not).");
  verb->footer("Example: priamos mission door laboratory --wait");
  verb->add_option("door", options->door, "its name in the map, or its number")->required();
  verb->add_flag("--wait", options->wait, "until the mission is over");
  AddPlannerOptions(*verb, *options);
  CompleteMission(*verb, options, PassDoor, exit_code);
}

void AddGotoVerb(CLI::App& mission, int& exit_code) {
  constexpr double kFarthest_m = 100, kTurn_deg = 360;
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "goto",
                       "Drive to a place, through doors if the way leads there; ends when the robot is under "
                       "way, with --wait when it is there (exit code 1: not).");
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
  CompleteMission(*verb, options, GoTo, exit_code);
}

void AddCorridorVerb(CLI::App& mission, int& exit_code) {
  constexpr double kLongest_m = 180, kTurn_deg = 360;
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "corridor",
                       "Follow the corridor in which the robot stands, by its sonars; ends when the robot is "
                       "under way, with --wait when it is at the end (exit code 1: not).");
  verb->footer("Example: priamos mission corridor 20 --wait");
  verb->add_option("distance", options->distance_m, "[m] how far; to the corridor's end if not given")
      ->check(CLI::Range(0.0, kLongest_m));
  verb->add_option("--yaw", options->yaw_deg,
                   "[deg] direction of the corridor, map frame; the way the robot stands if not given")
      ->check(CLI::Range(-kTurn_deg, kTurn_deg));
  verb->add_flag("--wait", options->wait, "until the mission is over");
  CompleteMission(*verb, options, FollowCorridor, exit_code);
}

void AddExploreVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb =
      AddVerb(mission, "explore",
              "Drive about until nothing of the floor is left that can be reached; ends when the robot "
              "is under way, with --wait when it is explored (exit code 1: not).");
  verb->footer("Example: priamos mission explore --wait");
  verb->add_flag("--wait", options->wait, "until the mission is over");
  CompleteMission(*verb, options, Explore, exit_code);
}

void AddLocateVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "locate",
                       "Have the robot find out where on the plan it is, whatever its pose says: it drives a "
                       "few metres, listens, and looks for a door; ends when the robot is under way, with "
                       "--wait when its place is known (exit code 1: not, for instance ambiguous).");
  verb->footer("Example: priamos mission locate --wait");
  verb->add_flag("--wait", options->wait, "until the mission is over");
  CompleteMission(*verb, options, Locate, exit_code);
}

void AddAbortVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb =
      AddVerb(mission, "abort", "End the mission that is under way and cancel what waits; the robot brakes.");
  verb->footer("Example: priamos mission abort");
  CompleteMission(*verb, options, Abort, exit_code);
}

void AddStatusVerb(CLI::App& mission, int& exit_code) {
  auto options = std::make_shared<MissionOptions>();
  auto* verb = AddVerb(mission, "status", "What the planner does (exit code 1: it failed or is silent).");
  verb->footer("Example: priamos mission status --wait");
  verb->add_flag("--wait", options->wait, "follow it until it is over");
  CompleteMission(*verb, options, Status, exit_code);
}

}  // namespace

void AddMissionCommand(CLI::App& cli, int& exit_code) {
  auto* mission = AddVerb(cli, "mission", "Order the planner, and ask how its mission stands.");
  mission->require_subcommand(1);
  AddDoorVerb(*mission, exit_code);
  AddGotoVerb(*mission, exit_code);
  AddCorridorVerb(*mission, exit_code);
  AddExploreVerb(*mission, exit_code);
  AddLocateVerb(*mission, exit_code);
  AddAbortVerb(*mission, exit_code);
  AddStatusVerb(*mission, exit_code);
  AddQueueVerbs(*mission, exit_code);
}

}  // namespace priamos::cli
