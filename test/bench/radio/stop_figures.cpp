// Emergency stops through two whole radio processes in lockstep: from publish on one bus to handler on the
// other.
#include <nlohmann/json.hpp>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "bus/type_files.hpp"
#include "figures.hpp"
#include "radio/radio_app.hpp"

namespace priamos::bench {
namespace {

const std::string kFolder = std::string(PRIAMOS_SOURCE_DIR) + "/test/bench/radio";

/// Two ends of the link on two buses, with a load of `load` times the line each way, on a line that flips
/// bits at `bit_error_rate`.
class StopRun {
 public:
  StopRun(double load, std::uint64_t seed, double bit_error_rate = 0)
      : load_(load), rng_(Rng::Stream(seed, "stops")), types_(bus::ReadTypeFiles(kFolder)) {
    lockstep_.AddBus("onboard");
    lockstep_.AddBus("offboard");
    lockstep_.AddSerialLine("tty-onboard", "tty-offboard",
                            {.latency_s = 0, .bit_error_rate = bit_error_rate});
    for (const std::string side : {"onboard", "offboard"})
      lockstep_.AddApp(bus::FactoryOf<radio::RadioApp>(), side,
                       {kFolder + "/link.toml", {"side=" + side, "port=tty-" + side, "types=" + kFolder}});
    lockstep_.SetTap([this](std::string_view bus, Time now, std::string_view channel, auto) {
      if (bus != "onboard" || channel != "STOP" || !offered_) return;
      latencies_s_.push_back(Seconds(now - *offered_));
      offered_.reset();
    });
  }

  /// Latencies [s] of stops that follow each other after a mean of `gap_s`, of those that arrived before the
  /// next.
  std::vector<double> Measure(int stops, double gap_s = 0.255) {
    Run(1.5);
    for (int i = 0; i < stops; ++i) {
      Run(gap_s * rng_.Uniform(0.82, 1.18));
      // Any moment, not only that of a tick.
      lockstep_.RunUntil(lockstep_.now() + Duration(rng_.Below(1000)));
      Publish("offboard", "STOP", "stop_t", {{"utime", ToUtime(lockstep_.now())}, {"action", 1}});
      offered_ = lockstep_.now();
    }
    Run(1);
    return latencies_s_;
  }

 private:
  void Publish(const std::string& bus, const std::string& channel, const std::string& type,
               const nlohmann::ordered_json& message) {
    lockstep_.DriverNode(bus).PublishRaw(channel, bus::FromJson(*types_.Find(type), message));
  }
  void Run(double seconds) {
    const Time end = lockstep_.now() + FromSeconds(seconds);
    while (lockstep_.now() < end) {
      // A report is about 200 bytes on the line.
      waiting_reports_ += load_ * 960 * 0.05 / 200;
      for (; waiting_reports_ >= 1; waiting_reports_ -= 1) Report();
      lockstep_.RunUntil(std::min(end, lockstep_.now() + Duration(50'000)));
    }
  }
  void Report() {
    const nlohmann::ordered_json report{{"utime", ToUtime(lockstep_.now())}, {"text", std::string(180, 'x')}};
    Publish("offboard", "ORDERS", "report_t", report);
    Publish("offboard", "BACKGROUND", "report_t", report);
    Publish("onboard", "EVENTS", "report_t", report);
    Publish("offboard", "DRIVE", "drive_t",
            {{"vx_m_s", 0.1}, {"vy_m_s", 0}, {"wz_rad_s", 0}, {"time_to_live_s", 0.2}, {"mode", 1}});
  }

  double load_;
  Rng rng_;
  bus::Schema own_ = bus::OwnTypes();
  bus::Schema types_;
  bus::Lockstep lockstep_{own_, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
  std::optional<Time> offered_;
  double waiting_reports_ = 0;
  std::vector<double> latencies_s_;
};

}  // namespace

void Stops(Figures& figures, const Effort& effort) {
  Figures::Section("Emergency stop, from publish on one bus to handler on the other, in lockstep");
  const int stops = effort.long_run ? 10000 : 2000;
  for (const double load : {0.0, 1.0, 3.0, 10.0}) {
    const auto latencies = StopRun(load, 1).Measure(stops);
    figures.Exactly(fmt::format("offered load {:g} of the line: stops that arrived", load), stops,
                    static_cast<double>(latencies.size()), "");
    figures.AtMost("  p99.9", 20, 1e3 * Quantile(latencies, 0.999), "ms");
    figures.Note("  median", 1e3 * Quantile(latencies, 0.5), "ms");
    figures.Note("  worst", 1e3 * Quantile(latencies, 1), "ms");
  }
  Figures::Section("The same on a line that damages frames, three times the line offered");
  const int on_bad_lines = effort.long_run ? 5000 : 1000;
  for (const auto& [rate, most_ms] :
       {std::pair(1e-3, 60.0), std::pair(3e-3, 100.0), std::pair(1e-2, 300.0)}) {
    const auto latencies = StopRun(3, 2, rate).Measure(on_bad_lines, 5);
    figures.Exactly(fmt::format("bit error rate {:g}: stops that arrived within 5 s", rate), on_bad_lines,
                    static_cast<double>(latencies.size()), "");
    figures.AtMost("  p99.9", most_ms, 1e3 * Quantile(latencies, 0.999), "ms");
    figures.Note("  median", 1e3 * Quantile(latencies, 0.5), "ms");
    figures.Note("  worst", 1e3 * Quantile(latencies, 1), "ms");
  }
}

}  // namespace priamos::bench
