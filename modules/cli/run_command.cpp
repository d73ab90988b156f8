#include <fmt/chrono.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "bus/own_types.hpp"
#include "bus/real_time_loop.hpp"
#include "cli/commands.hpp"
#include "cli/process_group.hpp"
#include "cli/report_files.hpp"
#include "cli/run_recorder.hpp"
#include "cli/scenario_driver.hpp"

namespace priamos::cli {
namespace {

constexpr const char* kOnboardUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* kOffboardUrl = "udpm://239.255.76.68:7668?ttl=0";
constexpr auto kLineReady = std::chrono::seconds(5);

struct RunOptions {
  std::string deployment = "config/sim";
  std::string scenario = "door";
  std::uint64_t seed = 1;
  std::string log_root = "logs";
};

std::filesystem::path OwnFolder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

std::filesystem::path MakeRunFolder(const RunOptions& options) {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const auto folder = std::filesystem::path(options.log_root) /
                      fmt::format("{:%Y%m%d-%H%M%S}-{}", fmt::localtime(now), options.scenario);
  std::filesystem::create_directories(folder);
  return std::filesystem::absolute(folder);
}

void WaitForFile(const std::filesystem::path& file, ProcessGroup& group) {
  const auto give_up = std::chrono::steady_clock::now() + kLineReady;
  while (!std::filesystem::exists(file)) {
    if (const auto dead = group.FirstDead()) throw std::runtime_error(*dead);
    if (std::chrono::steady_clock::now() > give_up)
      throw std::runtime_error(fmt::format("{}: the emulated line did not appear within 5 s", file.string()));
    usleep(10'000);
  }
}

/// A whole run in real time: processes, serial line, driver, logs.
class RealTimeRun {
 public:
  RealTimeRun(const RunOptions& options, const Scenario& scenario)
      : options_(options),
        scenario_(scenario),
        schema_(bus::OwnTypes()),
        onboard_(kOnboardUrl),
        offboard_(kOffboardUrl),
        onboard_node_(onboard_, schema_, clock_),
        offboard_node_(offboard_, schema_, clock_),
        folder_(MakeRunFolder(options)),
        recorder_(folder_.string()),
        start_(clock_.Now()),
        driver_(scenario, onboard_node_, offboard_node_,
                [this](Time now, const std::string& text) { Progress(now, text); }) {
    Record(onboard_, "onboard");
    Record(offboard_, "offboard");
  }

  /// Returns false when a signal or a dead process ended it early.
  bool Run() {
    Progress(clock_.Now(),
             fmt::format("scenario {}, seed {}: {}", options_.scenario, options_.seed, scenario_.title));
    StartLine();
    for (const auto& process : scenario_.processes) StartProcess(process);
    const bool whole = Loop();
    group_.End();
    recorder_.Flush();
    return whole;
  }

  const RunRecorder& recorder() const { return recorder_; }
  const std::filesystem::path& folder() const { return folder_; }
  bool started() const { return driver_.Started(); }
  /// Why the run ended as it did.
  std::string Reason() const { return reason_.value_or(driver_.Reason()); }

 private:
  void Record(bus::LcmBus& bus, const char* name) {
    bus.SubscribeEverything([this, name](std::string_view channel, std::span<const std::byte> bytes) {
      recorder_.OnMessage(name, clock_.Now(), channel, bytes);
    });
  }

  void Progress(Time now, const std::string& text) {
    std::cout << fmt::format("{:6.1f} s  {}", Seconds(now - start_), text) << std::endl;
  }

  void StartLine() {
    const auto& line = scenario_.line;
    group_.Start(
        "line",
        {(OwnFolder() / "priamos").string(), "link", "emulate", "--a", Tty("onboard"), "--b", Tty("offboard"),
         "--baud", std::to_string(line.baud), "--latency", fmt::format("{}", line.latency_s),
         "--bit-error-rate", fmt::format("{}", line.bit_error_rate), "--seed", std::to_string(options_.seed)},
        (folder_ / "line.txt").string());
    WaitForFile(Tty("onboard"), group_);
    WaitForFile(Tty("offboard"), group_);
  }

  void StartProcess(const ScenarioProcess& process) {
    std::vector<std::string> arguments{(OwnFolder() / ("priamos-" + process.module)).string(),
                                       "--config",
                                       (std::filesystem::path(options_.deployment) / process.config).string(),
                                       "--bus",
                                       process.bus == "onboard" ? kOnboardUrl : kOffboardUrl,
                                       "--seed",
                                       std::to_string(options_.seed)};
    if (!process.set.empty()) arguments.insert(arguments.end(), {"--set", process.set});
    if (process.module == "radio") arguments.insert(arguments.end(), {"--port", Tty(process.bus)});
    const auto name = process.bus + "-" + process.module;
    group_.Start(name, arguments, (folder_ / (name + ".txt")).string());
  }

  std::string Tty(const std::string& side) const { return (folder_ / ("tty-" + side)).string(); }

  bool Loop() {
    while (!driver_.Done(clock_.Now())) {
      pollfd fds[] = {{onboard_.fd(), POLLIN, 0}, {offboard_.fd(), POLLIN, 0}, {signals_.fd(), POLLIN, 0}};
      poll(fds, std::size(fds), 20);
      if (fds[2].revents != 0) return End("stopped by a signal"), false;
      onboard_.Drain();
      offboard_.Drain();
      driver_.Tick(clock_.Now());
      if (const auto dead = group_.FirstDead()) return End(*dead), false;
    }
    return true;
  }

  void End(const std::string& reason) {
    Progress(clock_.Now(), reason);
    reason_ = reason;
  }

  RunOptions options_;
  Scenario scenario_;
  bus::SignalWatch signals_;
  bus::Schema schema_;
  bus::MonotonicClock clock_;
  bus::LcmBus onboard_, offboard_;
  bus::Node onboard_node_, offboard_node_;
  std::filesystem::path folder_;
  RunRecorder recorder_;
  Time start_;
  ScenarioDriver driver_;
  ProcessGroup group_;
  std::optional<std::string> reason_;
};

int FailedStart(const RealTimeRun& run) {
  std::cerr << fmt::format("priamos run: not started: {}\nwhat every process said is in {}/*.txt\n",
                           run.Reason(), std::filesystem::relative(run.folder()).string());
  return 2;
}

int Run(const RunOptions& options) {
  const Scenario scenario = LoadScenario(options.deployment, options.scenario);
  const std::string map_file = MapFile(options.deployment, scenario);
  const DoorPlan door = LoadDoor(map_file, scenario.landmark_id);
  RealTimeRun run(options, scenario);
  const bool whole = run.Run();
  if (!run.started()) return FailedStart(run);
  const RunInfo info{options.scenario, options.seed, 1.0, door};
  const Summary summary = Summarise(run.recorder().record(), info);
  WriteReport(run.recorder().record(), summary, info, map_file, run.folder());
  PrintSummary(std::cout, summary);
  if (!run.recorder().good()) std::cout << "a log is incomplete: the disk is full or cannot be written\n";
  if (!summary.passed) std::cout << "not passed: " << run.Reason() << "\n";
  std::cout << "logs and report: " << std::filesystem::relative(run.folder()).string() << "/report.html\n";
  return whole && summary.passed && summary.contacts == 0 ? 0 : 1;
}

}  // namespace

void AddRunCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  auto* verb =
      cli.add_subcommand("run", "Run a scenario in real time: all processes, two buses, a 9600-baud line.");
  verb->footer("Example: priamos run --scenario door --seed 7");
  verb->add_option("--scenario", options->scenario, "a file of the deployment's scenarios/")
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "start pose, textures, noise, slip")->capture_default_str();
  verb->add_option("--deployment", options->deployment, "folder of configurations")->capture_default_str();
  verb->add_option("--logs", options->log_root, "a folder per run is made in it")->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = Run(*options); });
}

}  // namespace priamos::cli
