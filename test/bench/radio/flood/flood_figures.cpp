// Commands that two priamos-radio deliver over UDP and TCP while a stranger floods the robot's port. Real
// processes: run it with scripts/in-private-network.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <thread>

#include "bus/clocks/clock.hpp"
#include "bus/schema/schema.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/supervise/supervisor.hpp"
#include "test/bench/radio/figures.hpp"
#include "test/bench/radio/flood/radio_flood.hpp"
#include "test/bench/radio/flood/restart_figures.hpp"
#include "test/bench/radio/flood/two_radios.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bench {
namespace {

constexpr Duration kCommandPeriod{100'000};

/// Two ends of a link, commands every 100 ms.
class Driving {
 public:
  Driving(const std::string& programs, bool datagrams)
      : types_(FloodTypes()),
        onboard_(OnboardBus()),
        offboard_(OffboardBus()),
        processes_(Ends(programs, folder_.path().string(), datagrams), folder_.path().string(),
                   [](const std::string&) {}) {
    onboard_.Subscribe("DRIVE", [this](std::string_view, std::span<const std::byte>) { ++delivered_; });
    for (int i = 0; i < 2000 && !processes_.AllReady(); ++i) Wait();
    if (!processes_.AllReady()) throw std::runtime_error("priamos-radio does not start");
    for (int i = 0; i < 200 && delivered_ < 10; ++i) Share(0.05);
  }
  ~Driving() {
    processes_.StopAll();
    for (int i = 0; i < 400 && !processes_.AllStopped(); ++i) Wait();
  }
  Driving(const Driving&) = delete;
  Driving& operator=(const Driving&) = delete;

  /// Share of the commands that were delivered [%].
  double Share(double seconds) {
    const Time end = clock_.Now() + FromSeconds(seconds);
    Time next = clock_.Now();
    int sent = 0;
    const int before = delivered_;
    while (clock_.Now() < end) {
      if (clock_.Now() >= next) {
        next += kCommandPeriod;
        Publish(++sent);
      }
      Wait();
    }
    for (int i = 0; i < 60; ++i) Wait();
    return 100.0 * (delivered_ - before) / sent;
  }

 private:
  void Publish(int number) { offboard_.Publish("DRIVE", DriveCommand(types_, number)); }
  void Wait() {
    processes_.Step(clock_.Now());
    onboard_.Drain();
    offboard_.Drain();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  TemporaryFolder folder_;
  bus::Schema types_;
  bus::MonotonicClock clock_;
  bus::LcmBus onboard_, offboard_;
  cli::Supervisor processes_;
  int delivered_ = 0;
};

struct Case {
  std::string kind;
  double per_s;
  bool true_source = true;
};

/// `quick`: only the strongest floods, for a test.
std::vector<Case> DatagramCases(bool quick) {
  if (quick) return {{"short", 10'000}, {"next", 10'000}, {"long", 10'000, false}};
  return {{"short", 1000},   {"short", 5000},         {"short", 10'000}, {"long", 10'000},
          {"hello", 10'000}, {"long", 10'000, false}, {"next", 1000},    {"next", 10'000}};
}

std::vector<Case> ConnectionCases(bool quick) {
  if (quick) return {{"silent", 50}, {"garbage", 50}};
  return {{"silent", 2}, {"silent", 50}, {"garbage", 2}, {"garbage", 50}};
}

void Measure(Figures& figures, const std::string& programs, bool datagrams, bool quick, double seconds,
             double least) {
  Driving dut(programs, datagrams);
  figures.AtLeast("without a flood", least, dut.Share(seconds), "%");
  for (const Case& c : datagrams ? DatagramCases(quick) : ConnectionCases(quick)) {
    const Flood flood({.kind = c.kind,
                       .port = kOnboardPort,
                       .source = c.true_source ? kOffboardPort : std::uint16_t{0},
                       .per_s = c.per_s});
    const double share = dut.Share(seconds);
    figures.AtLeast(
        fmt::format("{}, {:g} per s{} ({:.0f} came)", c.kind, c.per_s,
                    c.true_source ? "" : ", from many ports", static_cast<double>(flood.sent()) / seconds),
        least, share, "%");
  }
}

}  // namespace
}  // namespace priamos::bench

int main(int argc, char** argv) {
  using namespace priamos::bench;
  CLI::App cli("Share of the commands that arrive while a stranger floods the port of a link over IP.");
  double seconds = 15;
  bool quick = false;
  double least = 95;
  std::string programs = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  cli.add_option("--seconds", seconds, "length of each flood")->capture_default_str();
  cli.add_option("--programs", programs, "folder of priamos-radio");
  cli.add_option("--least", least, "share asked for [%]")->capture_default_str();
  int restarts = 0;
  cli.add_flag("--quick", quick, "only the strongest floods");
  cli.add_option(
      "--restarts", restarts,
      "instead: how long commands stay away when an end is started again, so often, beside replays");
  CLI11_PARSE(cli, argc, argv);
  Figures figures;
  try {
    if (restarts > 0) {
      Restarts(figures, programs, restarts);
    } else {
      Figures::Section("Commands delivered over UDP, datagrams as if from the other end");
      Measure(figures, programs, true, quick, seconds, least);
      Figures::Section("Commands delivered over TCP, connections of a stranger");
      Measure(figures, programs, false, quick, seconds, least);
    }
  } catch (const std::exception& error) {
    std::cerr << "bench_flood: " << error.what() << "\n";
    return 2;
  }
  return figures.all_met() ? 0 : 1;
}
