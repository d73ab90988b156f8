#include "cli/supervise/deployment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "bus/parameters/parameter_messages.hpp"
#include "cli/supervise/supervisor.hpp"
#include "common/learned/learned_walls.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

/// Where a robot keeps what outlives its processes; the units of systemd name it, too.
constexpr std::string_view kStateFolder = "/var/lib/priamos";

std::string NameOf(const ScenarioProcess& process) {
  return process.module == "spacenavd" ? process.module : process.bus + "-" + process.module;
}

std::string Tty(const LaunchPlace& place, const std::string& side) {
  return place.run_folder + "/tty-" + side;
}

ProcessSpec LineSpec(const Deployment& deployment, const LaunchPlace& place) {
  const auto& line = deployment.line;
  ProcessSpec spec;
  spec.name = "line";
  spec.group = "line";
  spec.arguments = {place.program_folder + "/priamos",
                    "link",
                    "emulate",
                    "--a",
                    Tty(place, "onboard"),
                    "--b",
                    Tty(place, "offboard"),
                    "--baud",
                    std::to_string(line.baud),
                    "--latency",
                    fmt::format("{}", line.latency_s),
                    "--bit-error-rate",
                    fmt::format("{}", line.bit_error_rate),
                    "--seed",
                    std::to_string(place.seed)};
  // Killed it leaves links to ttys whose numbers the next terminal of anybody on this machine gets.
  spec.leftovers = {Tty(place, "onboard"), Tty(place, "offboard")};
  return spec;
}

/// Debian's spacenavd binds its socket relative to its working directory.
ProcessSpec SpacenavdSpec(const LaunchPlace& place) {
  fs::create_directories(fs::path(place.run_folder) / "run");
  const std::string config = place.run_folder + "/spnavrc";
  std::ofstream(config) << "serial = " << MouseTty(place) << "\nled = off\n";
  ProcessSpec spec;
  spec.name = "spacenavd";
  spec.group = "offboard";
  spec.arguments = {"/usr/bin/spacenavd", "-d", "-c", config, "-l", "/dev/stdout"};
  spec.notifies = false;
  spec.folder = place.run_folder;
  // It lets a serial mouse reset itself for 2 s before it answers anybody: that much must not be added to.
  spec.policy.first_back_off = std::chrono::milliseconds(400);
  return spec;
}

/// In simulation parameters are saved as long as the deployment is up; a robot's outlive it.
std::string SavedParametersFile(const Deployment& deployment, const ScenarioProcess& process,
                                const LaunchPlace& place) {
  const std::string folder = deployment.emulated_line ? place.run_folder : std::string(kStateFolder);
  return fmt::format("{}/{}-parameters.toml", folder, process.module);
}

ProcessSpec ModuleSpec(const Deployment& deployment, const ScenarioProcess& process, const LaunchPlace& place,
                       bool has_mouse) {
  const bool onboard = process.bus == "onboard";
  ProcessSpec spec;
  spec.name = NameOf(process);
  spec.group = process.bus;
  spec.after = WordsOfList(process.after);
  spec.drives = process.module == "robot";
  spec.policy.watchdog = FromSeconds(process.watchdog_s);
  spec.arguments = {place.program_folder + "/priamos-" + process.module,
                    "--config",
                    (fs::path(place.config_folder) / process.config).string(),
                    "--bus",
                    onboard ? deployment.OnboardUrl() : deployment.OffboardUrl(),
                    "--robot",
                    deployment.robot,
                    "--ttl",
                    std::to_string(onboard ? deployment.onboard_ttl : deployment.offboard_ttl),
                    "--seed",
                    std::to_string(place.seed)};
  const std::string& network = onboard ? deployment.onboard_network : deployment.offboard_network;
  if (!network.empty()) spec.arguments.insert(spec.arguments.end(), {"--network", network});
  const auto set = [&](const std::string& text) {
    spec.arguments.insert(spec.arguments.end(), {"--set", text});
  };
  if (!process.set.empty()) set(process.set);
  if (bus::ParameterProcess(process.module))
    spec.arguments.insert(spec.arguments.end(), {"--saved", SavedParametersFile(deployment, process, place)});
  if (process.module == "radio" && deployment.emulated_line) {
    spec.arguments.insert(spec.arguments.end(), {"--port", Tty(place, process.bus)});
    spec.after.push_back("line");
  }
  // In simulation the e-stop and what was learned of the building are remembered as long as the deployment is
  // up.
  if (process.module == "robot" && deployment.emulated_line)
    set("state_file=" + place.run_folder + "/robot-state");
  if (process.module == "planner" && deployment.emulated_line)
    set("learned_map=" + LearnedFiles(place).front());
  if (process.module == "teleop" && has_mouse) set("spacemouse.socket=" + MouseSocket(place));
  return spec;
}

/// The emulated line is where a radio is.
bool NeedsLine(const Deployment& deployment) {
  const auto& all = deployment.processes;
  return deployment.emulated_line &&
         (deployment.host.empty() || std::any_of(all.begin(), all.end(), [&](const ScenarioProcess& process) {
            return process.module == "radio" && StartsHere(deployment, process);
          }));
}

}  // namespace

std::vector<std::string> HostsOf(const Deployment& deployment) {
  std::set<std::string> hosts;
  for (const ScenarioProcess& process : deployment.processes)
    if (!process.host.empty()) hosts.insert(process.host);
  return {hosts.begin(), hosts.end()};
}

void RequireHost(const Deployment& deployment) {
  if (deployment.host.empty()) return;
  const auto hosts = HostsOf(deployment);
  if (std::find(hosts.begin(), hosts.end(), deployment.host) != hosts.end()) return;
  if (hosts.empty())
    throw ConfigError(fmt::format(
        "--host: expected none, because this deployment names no hosts, got \"{}\"; next: give its processes "
        "host = \"{}\" in deployment.toml",
        deployment.host, deployment.host));
  throw ConfigError(fmt::format("--host: expected a host of the deployment ({}), got \"{}\"{}",
                                fmt::join(hosts, ", "), deployment.host,
                                NearestText(deployment.host, hosts)));
}

bool StartsHere(const Deployment& deployment, const ScenarioProcess& process) {
  const bool of_group = deployment.group == "all" || process.bus == deployment.group;
  const bool of_host = deployment.host.empty() || process.host.empty() || process.host == deployment.host;
  return of_group && of_host;
}

std::vector<std::string> WordsOfList(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) {
    std::erase(word, ' ');
    if (!word.empty()) words.push_back(word);
  }
  return words;
}

std::vector<std::string> LearnedFiles(const LaunchPlace& place) {
  return {place.run_folder + "/" + std::string(kLearnedMapFile)};
}

std::string MouseTty(const LaunchPlace& place) {
  return Tty(place, "mouse");
}

std::string MouseSocket(const LaunchPlace& place) {
  return place.run_folder + "/run/spnav.sock";
}

std::vector<ProcessSpec> PlanOf(const Deployment& deployment, const LaunchPlace& place) {
  const auto& all = deployment.processes;
  const bool has_mouse =
      std::any_of(all.begin(), all.end(), [](const ScenarioProcess& p) { return p.module == "spacenavd"; });
  std::vector<ProcessSpec> plan;
  if (NeedsLine(deployment)) plan.push_back(LineSpec(deployment, place));
  for (const ScenarioProcess& process : all) {
    if (!StartsHere(deployment, process)) continue;
    plan.push_back(process.module == "spacenavd" ? SpacenavdSpec(place)
                                                 : ModuleSpec(deployment, process, place, has_mouse));
  }
  for (ProcessSpec& spec : plan) {
    // A process of the other group or host is another machine's business.
    std::erase_if(spec.after, [&](const std::string& name) {
      const bool here =
          std::any_of(plan.begin(), plan.end(), [&](const ProcessSpec& s) { return s.name == name; });
      const bool elsewhere =
          std::any_of(all.begin(), all.end(), [&](const ScenarioProcess& p) { return NameOf(p) == name; });
      return !here && elsewhere;
    });
  }
  return plan;
}

}  // namespace priamos::cli
