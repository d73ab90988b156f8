// What becomes of an operator's drive commands.
#include <algorithm>

#include "figures.hpp"
#include "test/bus/radio/measurement/command_measurement.hpp"

namespace priamos::bench {

using namespace bus::radio;

namespace {

void Drive(Figures& figures, const std::string& what, const DriveConditions& with, std::uint64_t seed) {
  const Obeyed obeyed = DriveRun(with, seed).Run();
  figures.AtLeast(what + ": obeyed of those offered", 99, 100 * obeyed.share(), "%");
  figures.AtMost("  longest gap between two obeyed", 0.25, obeyed.longest_gap_s, "s");
  figures.Note("  median from offer to delivery", obeyed.quantile_s(0.5), "s");
  figures.Note("  p95", obeyed.quantile_s(0.95), "s");
  figures.Note("  longest", obeyed.quantile_s(1), "s");
}

void DriveBesideStops(Figures& figures, const std::string& what, const DriveConditions& with,
                      std::uint64_t seed) {
  const Obeyed obeyed = DriveRun(with, seed).Run();
  figures.AtLeast(what + ": obeyed of those that no stop displaced", 99, 100 * obeyed.share_without_stops(),
                  "%");
  figures.Note("  of all that were offered", 100 * obeyed.share(), "%");
  figures.Note(
      "  displaced per stop",
      static_cast<double>(obeyed.displaced) / static_cast<double>(std::max<std::size_t>(obeyed.stops, 1)),
      "");
  figures.Note("  most by one stop", static_cast<double>(obeyed.most_displaced), "");
  figures.Note("  longest time from a stop to its acknowledgement", obeyed.longest_stop_s, "s");
}

}  // namespace

void Commands(Figures& figures, const Effort& effort) {
  Figures::Section("The shipped link, 20 drive commands a second, time-to-live 0.25 s, no emergency stops");
  const double seconds = effort.long_run ? 1200 : 300;
  const std::pair<double, double> delays_s[] = {
      {0.001, 0.001}, {0.025, 0.025}, {0.05, 0.05}, {0.1, 0}, {0, 0.1}};
  for (const double load : {0.0, 0.1, 1.0})
    for (const auto& [up_s, down_s] : delays_s)
      Drive(figures, fmt::format("load {:g}, delay {:g} up, {:g} s down", load, up_s, down_s),
            {.up_s = up_s, .down_s = down_s, .load = load, .jitter_s = 0.005, .seconds = seconds},
            effort.seed);
  Figures::Section("The same beside an emergency stop every 5 to 6 s");
  for (const auto& [up_s, down_s] : delays_s)
    DriveBesideStops(
        figures, fmt::format("delay {:g} up, {:g} s down", up_s, down_s),
        {.up_s = up_s, .down_s = down_s, .load = 1, .jitter_s = 0.005, .stops_hz = 0.2, .seconds = seconds},
        effort.seed);
}

}  // namespace priamos::bench
