#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options/verb_setup.hpp"
#include "cli/terminal/bus_session.hpp"
#include "cli/terminal/terminal_screen.hpp"
#include "cli/terminal/where_text.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

constexpr int kNoPose = 1;
/// DRIVE_STATUS and MISSION_STATUS come twice a second over the radio.
constexpr Duration kListen = std::chrono::milliseconds(1500);
constexpr Duration kShow = std::chrono::milliseconds(500);

struct WhereOptions {
  BusOptions bus;
  bool watch = false, json = false;
};

void Print(const WhereOptions& options, const Whereabouts& where, Time now, TerminalScreen& screen) {
  if (options.json) {
    std::cout << WhereJson(where, now).dump() << std::endl;
  } else if (options.watch) {
    screen.Show(WhereText(where, now));
  } else {
    std::cout << WhereText(where, now) << std::flush;
  }
}

int Run(const WhereOptions& options) {
  BusSession session("priamos where", options.bus, channels::kPose.name);
  auto poses = session.node().Subscribe(channels::kPose);
  auto drive = session.node().Subscribe(channels::kDriveStatus);
  auto mission = session.node().Subscribe(channels::kMissionStatus);
  Whereabouts where;
  TerminalScreen screen;
  const auto take = [&] {
    if (const auto pose = poses.Take()) where.pose = *pose;
    if (const auto status = drive.Take()) where.drive = *status;
    if (const auto status = mission.Take()) where.mission = *status;
    if (where.pose) session.Heard();
  };
  const Time until = options.watch ? Time::max() : session.now() + kListen;
  Time next = session.now() + kShow;
  const auto complete = [&] { return !options.watch && where.pose && where.drive && where.mission; };
  session.Watch(until, complete, [&] {
    take();
    if (!options.watch || session.now() < next) return;
    next += kShow;
    Print(options, where, session.now(), screen);
  });
  if (!options.watch) Print(options, where, session.now(), screen);
  return where.pose ? 0 : kNoPose;
}

}  // namespace

void AddWhereCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<WhereOptions>();
  auto* verb = AddVerb(
      cli, "where",
      "Where the robot believes to be, what it does, what limits it (exit code 1: no pose is heard).");
  verb->footer("Example: priamos where --watch");
  verb->add_flag("--watch", options->watch, "twice a second, until Ctrl-C");
  verb->add_flag("--json", options->json, "machine-readable");
  AddBusOption(*verb, options->bus);
  verb->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace priamos::cli
