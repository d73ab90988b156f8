// Real processes: `priamos link emulate` and two priamos-radio at full load, emergency stops in between.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "bus/clocks/clock.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/schema.hpp"
#include "bus/type_files.hpp"
#include "bus/wire/bus_address.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/supervise/supervisor.hpp"
#include "figures.hpp"

namespace priamos::bench {
namespace {

namespace fs = std::filesystem;

const std::string kFolder = std::string(PRIAMOS_SOURCE_DIR) + "/test/bench/radio";
const std::string kOnboardBus = bus::BusUrl(bus::kDefaultRobot, bus::BusSide::kOnboard, 0);
const std::string kOffboardBus = bus::BusUrl(bus::kDefaultRobot, bus::BusSide::kOffboard, 0);

/// Processor time of a process until now, user and system.
double CpuSeconds(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text, field;
  std::getline(stat, text);
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  double ticks = 0;
  for (int i = 3; i <= 15 && fields >> field; ++i)
    if (i >= 14) ticks += std::stod(field);
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

cli::ProcessSpec Emulator(const std::string& programs, const std::string& a, const std::string& b,
                          double bit_error_rate) {
  return {.name = "emulate",
          .group = {},
          .arguments = {programs + "/priamos", "link", "emulate", "--a", a, "--b", b, "--latency", "0",
                        "--bit-error-rate", fmt::format("{}", bit_error_rate)},
          .after = {},
          .notifies = true,
          .folder = {},
          .policy = {}};
}

cli::ProcessSpec Radio(const std::string& programs, const std::string& side, const std::string& port,
                       const std::string& bus) {
  return {.name = side,
          .group = {},
          .arguments = {programs + "/priamos-radio", "--config", kFolder + "/link.toml", "--types", kFolder,
                        "--" + side, "--port", port, "--bus", bus},
          .after = {"emulate"},
          .notifies = true,
          .folder = {},
          .policy = {}};
}

std::vector<cli::ProcessSpec> Processes(const std::string& programs, const std::string& folder,
                                        double bit_error_rate) {
  const std::string a = folder + "/tty-a", b = folder + "/tty-b";
  return {Emulator(programs, a, b, bit_error_rate), Radio(programs, "onboard", a, kOnboardBus),
          Radio(programs, "offboard", b, kOffboardBus)};
}

std::string NewFolder() {
  const fs::path folder = fs::temp_directory_path() / ("bench_radio." + std::to_string(getpid()));
  fs::create_directories(folder);
  return folder.string();
}

class RealTimeRun {
 public:
  RealTimeRun(const std::string& programs, double bit_error_rate)
      : types_(bus::ReadTypeFiles(kFolder)),
        folder_(NewFolder()),
        onboard_(kOnboardBus),
        offboard_(kOffboardBus),
        processes_(Processes(programs, folder_, bit_error_rate), folder_, [](const std::string&) {}),
        gap_s_(bit_error_rate > 0 ? 1.2 : 0.28) {
    onboard_.Subscribe("STOP", [this](std::string_view, std::span<const std::byte>) {
      if (offered_) latencies_s_.push_back(Seconds(clock_.Now() - *offered_));
      offered_.reset();
    });
    offboard_.Subscribe("EVENTS", [this](std::string_view, std::span<const std::byte>) { ++events_; });
    const Time patience = clock_.Now() + FromSeconds(10);
    while (!processes_.AllReady() && clock_.Now() < patience) {
      processes_.Step(clock_.Now());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (!processes_.AllReady()) throw std::runtime_error("the radio does not start: see " + folder_);
  }
  ~RealTimeRun() {
    processes_.StopAll();
    for (int i = 0; i < 400 && !processes_.AllStopped(); ++i) {
      processes_.Step(clock_.Now());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    fs::remove_all(folder_);
  }
  RealTimeRun(const RealTimeRun&) = delete;
  RealTimeRun& operator=(const RealTimeRun&) = delete;

  void Run(double seconds) {
    const Time end = clock_.Now() + FromSeconds(seconds);
    Time next_stop = clock_.Now() + FromSeconds(0.3), next_load = clock_.Now();
    while (clock_.Now() < end) {
      onboard_.Drain();
      offboard_.Drain();
      processes_.Step(clock_.Now());
      if (clock_.Now() >= next_load) {
        next_load += Duration(50'000);
        Load();
      }
      if (clock_.Now() >= next_stop) {
        lost_ += offered_ ? 1 : 0;
        next_stop += FromSeconds(gap_s_ * std::uniform_real_distribution<>(0.75, 1.25)(random_));
        offered_ = clock_.Now();
        Publish(offboard_, "STOP", "stop_t", {{"utime", ToUtime(clock_.Now())}, {"action", 1}});
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    for (const cli::ProcessReport& process : processes_.Report())
      if (process.starts != 1) throw std::runtime_error(process.name + " died: " + process.reason);
  }
  /// Processor time of the busier one of the two radios.
  double RadioCpuSeconds() const {
    double most = 0;
    for (const cli::ProcessReport& process : processes_.Report())
      if (process.name != "emulate") most = std::max(most, CpuSeconds(process.pid));
    return most;
  }
  const std::vector<double>& latencies_s() const { return latencies_s_; }
  int lost() const { return lost_; }
  int events() const { return events_; }

 private:
  void Publish(bus::LcmBus& bus, const std::string& channel, const std::string& type,
               const nlohmann::ordered_json& message) {
    bus.Publish(channel, bus::FromJson(*types_.Find(type), message));
  }
  /// More than the line carries, both ways.
  void Load() {
    const std::int64_t now = ToUtime(clock_.Now());
    const nlohmann::ordered_json report{{"utime", now}, {"text", std::string(180, 'x')}};
    for (const char* channel : {"ORDERS", "BACKGROUND"}) Publish(offboard_, channel, "report_t", report);
    Publish(offboard_, "DRIVE", "drive_t",
            {{"vx_m_s", 0.1}, {"vy_m_s", 0}, {"wz_rad_s", 0}, {"time_to_live_s", 0.2}, {"mode", 1}});
    Publish(onboard_, "EVENTS", "report_t", report);
    Publish(onboard_, "POSE", "pose_velocity_t",
            {{"utime", now},
             {"x_m", 1},
             {"y_m", 2},
             {"yaw_rad", 0},
             {"vx_m_s", 0},
             {"vy_m_s", 0},
             {"wz_rad_s", 0}});
    Publish(onboard_, "SONARS", "sonars_t", {{"utime", now}, {"range_m", std::vector<double>(24, 1.5)}});
  }

  bus::Schema types_;
  bus::MonotonicClock clock_;
  std::string folder_;
  bus::LcmBus onboard_, offboard_;
  cli::Supervisor processes_;
  double gap_s_;  ///< mean time between stops
  std::mt19937_64 random_{1};
  std::optional<Time> offered_;
  std::vector<double> latencies_s_;
  int lost_ = 0, events_ = 0;
};

}  // namespace

void RealTime(Figures& figures, const std::string& programs, const RealTimeOptions& options) {
  Figures::Section("Real time, over ptys, more offered than the line carries both ways");
  RealTimeRun run(programs, options.bit_error_rate);
  run.Run(5);
  const double before = run.RadioCpuSeconds();
  const int lost_before = run.lost();  // until the ends have agreed
  const auto warm = static_cast<std::ptrdiff_t>(run.latencies_s().size());
  run.Run(options.seconds);
  const double cpu = (run.RadioCpuSeconds() - before) / options.seconds;
  const std::vector<double> latencies(run.latencies_s().begin() + warm, run.latencies_s().end());
  figures.Note("emergency stops", static_cast<double>(latencies.size()), "");
  figures.Exactly("lost", 0, run.lost() - lost_before, "");
  figures.Note("events of the other direction meanwhile", run.events(), "");
  const double p99_ms = 1e3 * Quantile(latencies, 0.99);
  if (options.bit_error_rate > 0) figures.Note("emergency stop, p99", p99_ms, "ms");
  if (options.bit_error_rate <= 0) figures.AtMost("emergency stop, p99", 30, p99_ms, "ms");
  figures.Note("  median", 1e3 * Quantile(latencies, 0.5), "ms");
  figures.AtMost("processor time of the busier radio process", 3, 100 * cpu, "% of a core");
}

}  // namespace priamos::bench
