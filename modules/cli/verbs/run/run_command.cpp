#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <iostream>
#include <random>

#include "bus/clocks/clock_exchange.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/own_types.hpp"
#include "bus/real_time_loop.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/report/report_files.hpp"
#include "cli/report/run_recorder.hpp"
#include "cli/report/story_verdict.hpp"
#include "cli/scenario/scenario_story.hpp"
#include "cli/supervise/deployment.hpp"
#include "cli/supervise/link_emulate.hpp"
#include "cli/supervise/robot_owner.hpp"
#include "cli/supervise/supervisor.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/run/commands.hpp"
#include "common/data_folders.hpp"

namespace priamos::cli {
namespace {

struct RunOptions {
  std::string deployment = "sim";  ///< a name; its folder once it is found
  std::string scenario = "door";
  std::uint64_t seed = 1;
  std::string log_root;
  std::string robot;    ///< empty: a name of its own, so that it meets nobody
  std::string network;  ///< interface or its address; empty: as the route leads
  int ttl = 0;
  bool elsewhere = false;  ///< its processes are up already
  bool restart = false, json = false;
};

/// A robot that nobody else drives. $PRIAMOS_ROBOT does not count: it may be the one with real wheels.
std::string RobotOf(const RunOptions& options) {
  if (!options.robot.empty()) return options.robot;
  return fmt::format("run-{:04x}", std::random_device()() & 0xffff);
}

/// What a person reads; standard output belongs to the JSON.
std::ostream& People(const RunOptions& options) {
  return options.json ? std::cerr : std::cout;
}

/// A scenario is a deployment with an emulated line, and a story.
Deployment DeploymentOf(const Scenario& scenario, const RunOptions& options) {
  Deployment deployment;
  deployment.robot = RobotOf(options);
  deployment.title = scenario.title;
  deployment.onboard_network = deployment.offboard_network = options.network;
  deployment.onboard_ttl = deployment.offboard_ttl = options.ttl;
  if (options.elsewhere) return deployment;
  deployment.emulated_line = true;
  deployment.line = scenario.line;
  deployment.processes = scenario.processes;
  return deployment;
}

/// The hand's end of the emulated mouse's cable.
class MouseCable : public ByteStream {
 public:
  explicit MouseCable(const std::string& tty) : terminal_(tty) {}
  std::size_t Read(std::span<std::byte> into) override {
    const auto bytes = terminal_.Read(into.size());
    std::copy(bytes.begin(), bytes.end(), into.begin());
    return bytes.size();
  }
  std::size_t Write(std::span<const std::byte> bytes) override {
    terminal_.Write(bytes);
    return bytes.size();
  }

 private:
  PseudoTerminal terminal_;
};

/// A whole run in real time: processes, serial line, driver, logs.
class RealTimeRun {
 public:
  RealTimeRun(const RunOptions& options, const Scenario& scenario)
      : options_(options),
        scenario_(scenario),
        deployment_(DeploymentOf(scenario, options)),
        schema_(bus::OwnTypes()),
        onboard_(deployment_.OnboardUrl()),
        offboard_(deployment_.OffboardUrl()),
        onboard_node_(onboard_, schema_, clock_),
        offboard_node_(offboard_, schema_, clock_),
        onboard_clocks_(bus::ExchangeWhereNeeded(onboard_, schema_, clock_)),
        offboard_clocks_(bus::ExchangeWhereNeeded(offboard_, schema_, clock_)),
        start_(clock_.Now()),
        owner_(OwnRobot()),
        folder_(MakeRunFolder(options.log_root, options.scenario)),
        recorder_(folder_.string()),
        place_{ThisProgram().program_folder.string(), options.deployment, folder_.string(), options.seed},
        story_(MakeStory()),
        supervisor_(PlanOf(deployment_, place_), folder_.string(),
                    [this](const std::string& text) { Progress(clock_.Now(), text); }) {
    Record(onboard_, "onboard");
    Record(offboard_, "offboard");
  }

  /// Returns false when a signal or a dead process ended it early.
  bool Run() {
    Progress(clock_.Now(),
             fmt::format("robot {}, on buses of its own name; watch it with: priamos topic list "
                         "--watch --robot {}",
                         deployment_.robot, deployment_.robot));
    Progress(clock_.Now(),
             fmt::format("scenario {}, seed {}: {}", options_.scenario, options_.seed, scenario_.title));
    const bool whole = Loop();
    supervisor_.StopAll();
    while (!supervisor_.AllStopped()) {
      supervisor_.Step(clock_.Now());
      usleep(5'000);
    }
    recorder_.Flush();
    return whole;
  }

  const RunRecorder& recorder() const { return recorder_; }
  const std::filesystem::path& folder() const { return folder_; }
  const ScenarioStory& story() const { return *story_; }
  /// Why the run ended as it did.
  std::string Reason() const { return reason_.value_or(story_->Reason()); }
  const std::vector<StoryLine>& lines() const { return lines_; }

 private:
  /// Whoever started the processes owns the robot.
  std::unique_ptr<RobotOwner> OwnRobot() {
    if (options_.elsewhere) return nullptr;
    return std::make_unique<RobotOwner>(deployment_, schema_, clock_,
                                        [this](const std::string& text) { Progress(clock_.Now(), text); });
  }

  void Record(bus::LcmBus& bus, const char* name) {
    bus.SubscribeEverything([this, name](std::string_view channel, std::span<const std::byte> bytes) {
      recorder_.OnMessage(name, clock_.Now(), channel, bytes);
    });
  }

  void Progress(Time now, const std::string& text) {
    lines_.push_back({Seconds(now - start_), text});
    People(options_) << fmt::format("{:6.1f} s  {}", Seconds(now - start_), text) << std::endl;
  }

  std::unique_ptr<ScenarioStory> MakeStory() {
    return FindStory(scenario_.story)
        .make({scenario_, options_.seed, onboard_node_, offboard_node_,
               [this] { return std::make_unique<MouseCable>(MouseTty(place_)); },
               [this](Time now, const std::string& text) { Progress(now, text); }});
  }

  bool Loop() {
    while (!story_->Done(clock_.Now())) {
      pollfd fds[] = {{onboard_.fd(), POLLIN, 0},
                      {offboard_.fd(), POLLIN, 0},
                      {signals_.fd(), POLLIN, 0},
                      {supervisor_.fd(), POLLIN, 0}};
      poll(fds, std::size(fds), 20);
      if (fds[2].revents != 0) {
        End("stopped by a signal");
        return false;
      }
      if (owner_) owner_->Listen();
      if (const auto lost = owner_ ? owner_->lost() : std::nullopt) {
        End(*lost);
        return false;
      }
      onboard_.Drain();
      offboard_.Drain();
      for (bus::ClockExchange* clocks : {onboard_clocks_.get(), offboard_clocks_.get()})
        if (clocks != nullptr) clocks->Tick(clock_.Now());
      story_->Tick(clock_.Now());
      supervisor_.Step(clock_.Now());
      // What cannot start now will not start later: a scenario ends with the first failure, a robot goes on.
      for (const ProcessReport& report : supervisor_.Report())
        if (!report.reason.empty() && !options_.restart) {
          reason_ = fmt::format("{} ended by itself, {}", report.name, report.reason);
          return false;
        }
    }
    return true;
  }

  void End(const std::string& reason) {
    Progress(clock_.Now(), reason);
    reason_ = reason;
  }

  RunOptions options_;
  Scenario scenario_;
  Deployment deployment_;
  bus::SignalWatch signals_;
  bus::Schema schema_;
  bus::HostClock clock_;
  bus::LcmBus onboard_, offboard_;
  bus::Node onboard_node_, offboard_node_;
  std::unique_ptr<bus::ClockExchange> onboard_clocks_, offboard_clocks_;
  Time start_;
  std::unique_ptr<RobotOwner> owner_;
  std::filesystem::path folder_;
  RunRecorder recorder_;
  LaunchPlace place_;
  std::unique_ptr<ScenarioStory> story_;
  Supervisor supervisor_;
  std::optional<std::string> reason_;
  std::vector<StoryLine> lines_;
};

int FailedStart(const RealTimeRun& run, bool json) {
  if (json) std::cout << JsonLine({{"started", false}, {"reason", run.Reason()}}) << std::endl;
  std::cerr << fmt::format("priamos run: not started: {}\noutput of every process:  {}/*.txt\n", run.Reason(),
                           ShownFrom(std::filesystem::current_path(), run.folder()));
  return 2;
}

int Run(RunOptions options) {
  options.deployment = FolderOfDeployment(options.deployment);
  options.log_root = LogRoot(options.log_root);
  const Scenario scenario = LoadScenario(options.deployment, options.scenario);
  const std::string map_file = MapFile(options.deployment, scenario);
  const auto door = LoadDoor(map_file, scenario.landmark_id, FindStory(scenario.story).seeks_door);
  RealTimeRun run(options, scenario);
  const bool whole = run.Run();
  if (!run.story().Started()) return FailedStart(run, options.json);
  const RunInfo info{options.scenario,
                     options.seed,
                     1.0,
                     door,
                     run.Reason(),
                     run.lines(),
                     LoadTrueWorld(options.deployment, scenario, options.seed)};
  Summary summary = Summarise(run.recorder().record(), info);
  const std::string verdict = Judge(scenario, run.story(), summary);
  summary.reason = whole ? verdict : run.Reason();
  WriteReport(run.recorder().record(), summary, info, map_file, run.folder());
  PrintSummary(People(options), summary);
  if (options.json) std::cout << SummariesAsJson({summary}, JsonForm::kOneLine) << std::endl;
  if (!run.recorder().good())
    People(options) << "a log is incomplete: the disk is full or cannot be written\n";
  if (!summary.passed) People(options) << "not passed: " << summary.reason << "\n";
  People(options) << "logs and report: "
                  << ShownFrom(std::filesystem::current_path(), run.folder() / "report.html") << "\n";
  return whole && summary.passed && summary.contacts == 0 ? 0 : 1;
}

}  // namespace

void AddRunCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  auto* verb =
      AddVerb(cli, "run", "Run a scenario in real time: all processes, two buses, a 9600-baud line.");
  verb->footer("Example: priamos run --scenario door --seed 7");
  verb->add_option("--scenario", options->scenario, "a file of the deployment's scenarios/")
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "start pose, textures, noise, slip")->capture_default_str();
  AddDeploymentOption(*verb, options->deployment);
  AddLogsOption(*verb, options->log_root, "a folder per run is made in it");
  auto* robot =
      verb->add_option("--robot", options->robot,
                       "name of the robot; without it one that nobody has, so that the run meets nobody");
  verb->add_option("--network", options->network,
                   "interface (eth1) or its address for the buses; default: as the route for multicast leads")
      ->envname(bus::kNetworkVariable);
  verb->add_option("--ttl", options->ttl, "routers a message may pass; 0: this host")
      ->envname(bus::kTtlVariable)
      ->check(CLI::Range(0, 255));
  verb->add_flag("--elsewhere", options->elsewhere,
                 "start no process: those of the scenario are up already, here or on other hosts")
      ->needs(robot);
  verb->add_flag("--restart", options->restart, "start again what died or hung, as `priamos up` does");
  verb->add_flag("--json", options->json, "summary.json on standard output, all else on standard error");
  verb->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace priamos::cli
