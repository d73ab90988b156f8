#include "test/bench/radio/flood/restart_figures.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bus/clocks/clock.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "test/bench/radio/flood/eavesdropper.hpp"
#include "test/bench/radio/flood/radio_flood.hpp"
#include "test/bench/radio/flood/two_radios.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bench {
namespace {

constexpr Duration kCommandPeriod{20'000}, kGivenUp{20'000'000};
constexpr double kFlood_per_s = 10'000, kAsked_s = 2;

enum End : std::size_t { kOnboard, kOffboard };

/// Two ends over UDP, each of which can be started again; commands 50 times a second.
class RestartRig {
 public:
  explicit RestartRig(const std::string& programs)
      : types_(FloodTypes()),
        onboard_(OnboardBus()),
        offboard_(OffboardBus()),
        specs_(Ends(programs, folder_.path().string(), true)) {
    onboard_.Subscribe("DRIVE", [this](std::string_view, std::span<const std::byte>) { ++delivered_; });
    for (const End end : {kOnboard, kOffboard}) Start(end);
    if (UntilCommandsFlow() < 0) throw std::runtime_error("no command arrives");
  }
  ~RestartRig() {
    for (const End end : {kOnboard, kOffboard}) Stop(end);
  }
  RestartRig(const RestartRig&) = delete;
  RestartRig& operator=(const RestartRig&) = delete;

  /// Ends one end and starts it again; seconds from the start of its process to the next command that
  /// arrives, negative when none did in 20 s.
  double Restart(End end) {
    Stop(end);
    Start(end);
    return UntilCommandsFlow();
  }
  /// Lets time pass.
  void Run(double seconds) {
    for (const Time end = clock_.Now() + FromSeconds(seconds); clock_.Now() < end;) Step();
  }
  /// All that was ever sent to `end` is replayed to it until the result ends.
  std::unique_ptr<Flood> Replay(End end) {
    FloodOptions options{.kind = "replay",
                         .port = end == kOnboard ? kOnboardPort : kOffboardPort,
                         .source = end == kOnboard ? kOffboardPort : kOnboardPort,
                         .per_s = kFlood_per_s,
                         .recorded = to_[end].Recorded()};
    return std::make_unique<Flood>(options);
  }

 private:
  void Start(End end) {
    processes_[end] = std::make_unique<cli::Supervisor>(std::vector{specs_[end]}, folder_.path().string(),
                                                        [](const auto&) {});
  }
  void Stop(End end) {
    processes_[end]->StopAll();
    for (int i = 0; i < 1000 && !processes_[end]->AllStopped(); ++i) Step();
    processes_[end].reset();
    Run(0.3);  // what was under way has arrived
  }
  double UntilCommandsFlow() {
    const Time begin = clock_.Now();
    for (const int before = delivered_; clock_.Now() < begin + kGivenUp; Step())
      if (delivered_ > before) return Seconds(clock_.Now() - begin);
    return -1;
  }
  void Step() {
    const Time now = clock_.Now();
    if (now >= next_) {
      next_ = now + kCommandPeriod;
      offboard_.Publish("DRIVE", DriveCommand(types_, ++number_));
    }
    for (auto& process : processes_)
      if (process) process->Step(now);
    for (Eavesdropper& wire : to_) wire.Listen();
    onboard_.Drain();
    offboard_.Drain();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  TemporaryFolder folder_;
  bus::Schema types_;
  bus::MonotonicClock clock_;
  bus::LcmBus onboard_, offboard_;
  std::vector<cli::ProcessSpec> specs_;
  std::unique_ptr<cli::Supervisor> processes_[2];
  Eavesdropper to_[2]{Eavesdropper(kOnboardPort), Eavesdropper(kOffboardPort)};
  Time next_{};
  int number_ = 0, delivered_ = 0;
};

void Show(Figures& figures, const std::string& what, const std::vector<double>& times_s, bool asked) {
  const double worst = *std::max_element(times_s.begin(), times_s.end());
  const auto never = std::count_if(times_s.begin(), times_s.end(), [](double s) { return s < 0; });
  figures.Note(what + ": median", Quantile(times_s, 0.5), "s");
  if (asked) figures.AtMost(what + ": longest", kAsked_s, worst, "s");
  if (!asked) figures.Note(what + ": longest", worst, "s");
  figures.Exactly(what + ": never", 0, static_cast<double>(never), "restarts");
}

}  // namespace

void Restarts(Figures& figures, const std::string& programs, int restarts) {
  RestartRig rig(programs);
  const char* const names[] = {"onboard", "offboard"};
  Figures::Section(
      fmt::format("From the start of an end to the next command, over UDP, {} restarts each", restarts));
  for (const End again : {kOnboard, kOffboard}) {
    std::vector<double> times_s;
    for (int i = 0; i < restarts; ++i) times_s.push_back(rig.Restart(again));
    Show(figures, fmt::format("{}, no flood", names[again]), times_s, false);
  }
  const std::vector<End> targets[] = {{kOnboard}, {kOffboard}, {kOnboard, kOffboard}};
  for (const End again : {kOnboard, kOffboard}) {
    for (const std::vector<End>& flooded : targets) {
      std::vector<double> times_s;
      for (int i = 0; i < restarts; ++i) {
        std::vector<std::unique_ptr<Flood>> floods;
        for (const End end : flooded) floods.push_back(rig.Replay(end));
        rig.Run(0.5);
        times_s.push_back(rig.Restart(again));
      }
      const std::string end = flooded.size() > 1 ? "both" : names[flooded.front()];
      Show(figures, fmt::format("{}, replays of all starts to {}", names[again], end), times_s, true);
    }
  }
}

}  // namespace priamos::bench
