#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bus/clocks/host_clock.hpp"
#include "bus/own_types.hpp"
#include "bus/real_time_loop.hpp"
#include "bus/schema/schema.hpp"
#include "bus/wire/multicast.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/supervise/deployment.hpp"
#include "cli/supervise/robot_owner.hpp"
#include "cli/supervise/scenario_choice.hpp"
#include "cli/supervise/supervisor.hpp"
#include "cli/supervise/supervisor_control.hpp"
#include "cli/supervise/up_state.hpp"
#include "cli/verbs/deployment/commands.hpp"
#include "cli/verbs/deployment/up_queries.hpp"
#include "common/config.hpp"
#include "common/data_folders.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using std::chrono::milliseconds;

constexpr auto kUpWithin = std::chrono::seconds(20);

struct UpOptions {
  std::string deployment = "sim";
  std::string log_root;
  std::string group, robot, host, network, scenario;
  std::uint64_t seed = 1;
  bool detach = false, json = false;
};

/// Run of `priamos up` in the foreground.
class UpRun {
 public:
  UpRun(const UpOptions& options, const std::string& folder, const Deployment& deployment)
      : options_(options),
        lock_(options.log_root),
        schema_(bus::OwnTypes()),
        start_(clock_.Now()),
        owner_(deployment, schema_, clock_, [this](const std::string& text) { Say(text); }),
        place_{ThisProgram().program_folder.string(), folder,
               MakeRunFolder(options.log_root, "up-" + fs::path(options.deployment).filename().string()),
               options.seed},
        deployment_(deployment),
        supervisor_(PlanOf(InFirstScenario(), place_), place_.run_folder,
                    [this](const std::string& text) { Say(text); }),
        control_(Sides(), supervisor_,
                 {Offers(), FirstScenario(), [this](const std::string& name) { return BeginAnew(name); }}) {}

  int Run() {
    bool ready = false;
    Time written{};
    while (!Signalled() && !owner_.lost()) {
      const Time now = clock_.Now();
      owner_.Listen();
      control_.Step(now);
      supervisor_.Step(now);
      if (!ready && supervisor_.AllReady()) Say("all processes are ready");
      const bool changed = ready != supervisor_.AllReady();
      ready = supervisor_.AllReady();
      if (!changed && now - written < milliseconds(250)) continue;
      written = now;
      Write(now);
    }
    const auto lost = owner_.lost();
    Say(lost ? "going down: " + *lost : "going down");
    supervisor_.StopAll();
    while (!supervisor_.AllStopped()) {
      supervisor_.Step(clock_.Now());
      std::this_thread::sleep_for(milliseconds(5));
    }
    supervisor_.Step(clock_.Now());
    Write(clock_.Now());
    Say("everything is down");
    return lost ? kNotThere : 0;
  }

 private:
  /// Empty: the world is as the deployment's files have it.
  std::string FirstScenario() const {
    if (!options_.scenario.empty()) return options_.scenario;
    const auto all = WordsOfList(deployment_.scenarios);
    return all.empty() ? "" : all.front();
  }
  Deployment InFirstScenario() const {
    const std::string name = FirstScenario();
    return name.empty() ? deployment_ : InScenario(deployment_, place_.config_folder, name);
  }
  std::vector<SupervisorControl::Side> Sides() const {
    std::vector<SupervisorControl::Side> sides;
    for (const auto& [name, node] : owner_.nodes()) sides.push_back({name, node});
    return sides;
  }
  /// The whole of a simulated robot, or nothing of it, begins anew.
  std::vector<OfferedScenario> Offers() const {
    if (deployment_.group != "all" || !deployment_.host.empty()) return {};
    return OfferedScenarios(deployment_, place_.config_folder);
  }
  /// Everything but the line and the mouse starts again: no message, lease or mission of before is left.
  bool BeginAnew(const std::string& scenario) {
    try {
      const Deployment in_scenario = InScenario(deployment_, place_.config_folder, scenario);
      auto plan = PlanOf(in_scenario, place_);
      std::erase_if(plan, [](const ProcessSpec& spec) { return spec.group == "line" || !spec.notifies; });
      supervisor_.Renew(std::move(plan), LearnedFiles(place_));
      planner_set_ = PlannerSetOf(in_scenario);
    } catch (const ConfigError& error) {
      Say(error.what());
      return false;
    }
    Say("the world begins anew: " + scenario);
    return true;
  }
  static std::string PlannerSetOf(const Deployment& deployment) {
    const auto& all = deployment.processes;
    const auto planner =
        std::find_if(all.begin(), all.end(), [](const ScenarioProcess& p) { return p.module == "planner"; });
    return planner == all.end() ? "" : planner->set;
  }
  /// Waits for something to do, at most 20 ms.
  bool Signalled() {
    pollfd fds[] = {{signals_.fd(), POLLIN, 0}, {supervisor_.fd(), POLLIN, 0}};
    poll(fds, std::size(fds), 20);
    return fds[0].revents != 0;
  }
  void Say(const std::string& text) {
    const double t_s = Seconds(clock_.Now() - start_);
    if (options_.json) return void(std::cout << ordered_json{{"t_s", t_s}, {"text", text}} << std::endl);
    std::cout << fmt::format("{:6.1f} s  {}", t_s, text) << std::endl;
  }
  void Write(Time now) {
    UpState state{options_.deployment,    place_.config_folder,  planner_set_,         place_.run_folder,
                  supervisor_.AllReady(), Seconds(now - start_), supervisor_.Report(), {},
                  owner_.alarms()};
    for (const ProcessReport& p : state.processes)
      state.ages_s.push_back(p.since == Time{} ? state.up_s : Seconds(now - p.since));
    const bool written = WriteUpState(options_.log_root, state);
    if (!written && state_written_)
      Say(fmt::format("{}: `priamos status` cannot be kept up to date: {}", options_.log_root,
                      std::strerror(errno)));
    state_written_ = written;
  }

  UpOptions options_;
  bus::SignalWatch signals_;
  UpLock lock_;
  bus::Schema schema_;
  bus::HostClock clock_;
  Time start_;
  RobotOwner owner_;
  LaunchPlace place_;
  Deployment deployment_;
  Supervisor supervisor_;
  SupervisorControl control_;
  std::string planner_set_ = PlannerSetOf(InFirstScenario());
  bool state_written_ = true;  ///< up.json holds the newest state
};

/// Checks the buses before any process is started: throws if there is no route for multicast, without which
/// none can run.
void RequireBuses(const Deployment& deployment) {
  if (deployment.group != "offboard") bus::RequireMulticastRoute(deployment.OnboardUrl());
  if (deployment.group != "onboard") bus::RequireMulticastRoute(deployment.OffboardUrl());
}

int UpNow(const UpOptions& options) {
  const std::string folder = FolderOfDeployment(options.deployment);
  auto deployment = LoadConfig<Deployment>((fs::path(folder) / "deployment.toml").string());
  if (!options.group.empty()) deployment.group = options.group;
  if (!options.robot.empty()) deployment.robot = options.robot;
  deployment.host = options.host;
  if (!options.network.empty()) deployment.onboard_network = deployment.offboard_network = options.network;
  if (!options.scenario.empty() && !deployment.emulated_line)
    throw ConfigError(fmt::format("--scenario: expected none, because {} is no simulation, got \"{}\"",
                                  options.deployment, options.scenario));
  RequireHost(deployment);
  RequireBuses(deployment);
  return UpRun(options, folder, deployment).Run();
}

bool HasAlarm(const UpState& state) {
  return std::any_of(state.processes.begin(), state.processes.end(), [](const auto& p) { return p.alarm; });
}

/// Reason of the first process that ended, as `: onboard-robot: exit code 2: ...`; empty if there is none.
std::string Reasons(const std::optional<UpState>& state) {
  if (!state) return "";
  for (const ProcessReport& p : state->processes)
    if (!p.reason.empty()) return fmt::format(": {}: {}", p.name, p.reason);
  return "";
}

/// The child in the background, which writes into `console`; never returns.
[[noreturn]] void RunInBackground(const UpOptions& options, const std::string& console) {
  setsid();
  const int output = open(console.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  try {
    _exit(UpNow(options));
  } catch (const std::exception& error) {
    std::cerr << "priamos: " << error.what() << std::endl;
    _exit(2);
  }
}

/// Exit code once everything is ready or the child has ended; nullopt for an alarm or at the end of the time.
std::optional<int> WaitUntilReady(const UpOptions& options, pid_t child, const std::string& console) {
  const auto give_up = std::chrono::steady_clock::now() + kUpWithin;
  while (std::chrono::steady_clock::now() < give_up) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) {
      std::cerr << std::ifstream(console).rdbuf();
      return WIFEXITED(status) ? WEXITSTATUS(status) : kNotThere;
    }
    const auto state = ReadUpState(options.log_root);
    const bool its = UpLock::Holder(options.log_root) == child && state;
    if (its && state->ready) {
      Show(*state, options.json);
      return 0;
    }
    if (its && HasAlarm(*state)) return std::nullopt;
    std::this_thread::sleep_for(milliseconds(20));
  }
  return std::nullopt;
}

/// The one in the background is a child that this process waits for until everything is ready.
int UpDetached(const UpOptions& options) {
  fs::create_directories(options.log_root);
  const std::string console = (fs::path(options.log_root) / "up.txt").string();
  const pid_t pid = fork();
  if (pid == 0) RunInBackground(options, console);
  if (const auto code = WaitUntilReady(options, pid, console)) return *code;
  if (const auto state = ReadUpState(options.log_root)) Show(*state, options.json);
  std::cerr << fmt::format("priamos up: not everything became ready{}; `priamos down` ends it\n",
                           Reasons(ReadUpState(options.log_root)));
  return kNotThere;
}

}  // namespace

void AddUpCommands(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<UpOptions>();
  auto* up = AddVerb(cli, "up", "Start the processes of a deployment, and start again what dies or hangs.");
  up->footer("Example: priamos up sim, Ctrl-C ends it; or priamos up sim --detach, later priamos down");
  up->add_option("deployment", options->deployment,
                 "sim, robot, or a folder with a deployment.toml, with a slash")
      ->capture_default_str();
  up->add_option("--group", options->group, "only these processes; default: as in the deployment")
      ->check(CLI::IsMember({"all", "onboard", "offboard"}));
  up->add_option("--robot", options->robot,
                 "its name, from which groups and ports follow; default: as in the deployment")
      ->envname(bus::kRobotVariable);
  up->add_option("--host", options->host,
                 "only the processes of this host of the deployment, and those of every host; default: all");
  up->add_option("--network", options->network,
                 "interface (eth1) or its address for the buses; default: as in the deployment")
      ->envname(bus::kNetworkVariable);
  up->add_option("--scenario", options->scenario,
                 "the scenario in whose world a simulated robot begins; default: as in the deployment");
  up->add_option("--seed", options->seed, "seed of simulated hardware")->capture_default_str();
  up->add_flag("--detach", options->detach, "return when everything is ready");
  up->add_flag("--json", options->json, "machine-readable");
  AddUpLogsOption(*up, options->log_root);
  up->callback(
      [options, &exit_code] { exit_code = options->detach ? UpDetached(*options) : UpNow(*options); });
  AddUpQueries(cli, exit_code);
}

}  // namespace priamos::cli
