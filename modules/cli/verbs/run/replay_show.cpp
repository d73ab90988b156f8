#include <fmt/format.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bus/clocks/clock.hpp"
#include "bus/log/log_player.hpp"
#include "bus/own_types.hpp"
#include "bus/process_config.hpp"
#include "bus/real_time_loop.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/run/commands.hpp"
#include "common/config.hpp"
#include "console/greeting.hpp"
#include "console/log_of_file.hpp"
#include "console/replay_station.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kPeriod_ms = 5;

struct ShowOptions {
  std::string log;
  std::string deployment = "sim";
  std::string speed = "1";
  int port = 8080;
  bool paused = false, json = false;
};

/// A folder of a run stands for what its operator saw.
std::string LogIn(const std::string& path) {
  if (!fs::is_directory(path)) return path;
  const fs::path log = fs::path(path) / "offboard.lcmlog";
  if (!fs::exists(log)) throw std::runtime_error(fmt::format("{}: expected offboard.lcmlog in it", path));
  return log.string();
}

bus::LogPlayer PlayerOf(const ShowOptions& options, Time now) {
  bus::LogSelection selection;
  for (const std::string_view channel : console::kShownChannels) selection.only.emplace_back(channel);
  const std::string path = LogIn(options.log);
  bus::LogPlayer player(bus::LogReader(path), selection);
  if (player.events() == 0)
    throw std::runtime_error(fmt::format(
        "{}: expected messages of a robot, got none that the page shows; next: priamos log info {}", path,
        path));
  player.SetSpeed(ParseSpeed(options.speed), now);
  player.Pause(options.paused, now);
  return player;
}

int Show(const ShowOptions& options) {
  const fs::path folder = FolderOfDeployment(options.deployment);
  const auto config = bus::LoadAppConfig<console::ConsoleConfig>({(folder / "console.toml").string(), {}});
  const auto plan = LoadConfig<GroundPlan>((folder / config.map).string());
  const auto link = LoadConfig<bus::radio::LinkConfig>((folder / config.link).string());
  const bus::Schema schema = bus::OwnTypes();
  const bus::MonotonicClock clock;
  bus::LogPlayer player = PlayerOf(options, clock.Now());
  const std::string greeting = console::Greeting(config, plan, link, Seconds(player.length()));
  const auto events = static_cast<std::int64_t>(player.events());
  const bus::SignalWatch signals;
  WebServerOptions server;
  server.port = options.port;
  server.ports = config.ports;
  server.access.foxglove_origins = console::WordsOf(config.foxglove_origins);
  console::ReplayStation station(std::make_unique<console::LogOfFile>(std::move(player)), schema, plan,
                                 greeting, server);
  if (options.json)
    std::cout << JsonLine({{"address", station.address()}, {"events", events}}) << std::endl;
  else
    std::cout << fmt::format("the log is shown at {} (Ctrl-C ends it)", station.address()) << std::endl;
  while (!signals.Came(kPeriod_ms)) station.Tick(clock.Now());
  return 0;
}

}  // namespace

void AddReplayShowVerb(CLI::App& replay, int& exit_code) {
  auto options = std::make_shared<ShowOptions>();
  auto* verb =
      AddVerb(replay, "show", "Show a log on the station's page, in a browser: pause, step, seek, speed.");
  verb->footer("Example: priamos replay show logs/recorded/door-offboard.lcmlog --speed 2");
  verb->add_option("log", options->log, "LCM log of the workstation's bus, or folder of a run")
      ->required()
      ->check(CLI::ExistingPath);
  AddDeploymentOption(*verb, options->deployment);
  verb->add_option("--speed", options->speed, "times its own speed, or max")->capture_default_str();
  verb->add_option("--port", options->port, "first TCP port that is tried; 0: any")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  verb->add_flag("--paused", options->paused, "begin paused");
  CompleteVerb(*verb, options, Show, exit_code, "the address machine-readable");
}

}  // namespace priamos::cli
