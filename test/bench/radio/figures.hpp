#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace priamos::bench {

/// Figures beside what was asked of them, as a table; remembers whether one was missed.
class Figures {
 public:
  void AtLeast(const std::string& what, double asked, double got, const std::string& unit) {
    Print(what, fmt::format(">= {:g}", asked), got, unit, got >= asked);
  }
  void AtMost(const std::string& what, double asked, double got, const std::string& unit) {
    Print(what, fmt::format("<= {:g}", asked), got, unit, got <= asked);
  }
  void Exactly(const std::string& what, double asked, double got, const std::string& unit) {
    Print(what, fmt::format("= {:g}", asked), got, unit, got == asked);
  }
  void Note(const std::string& what, double got, const std::string& unit) {
    fmt::print("  {:<66} {:>10} {:>12.6g} {}\n", what, "", got, unit);
  }
  static void Section(const std::string& title) { fmt::print("\n{}\n", title); }
  bool all_met() const { return all_met_; }

 private:
  void Print(const std::string& what, const std::string& asked, double got, const std::string& unit,
             bool met) {
    fmt::print("  {:<66} {:>10} {:>12.6g} {}{}\n", what, asked, got, unit, met ? "" : "   MISSED");
    std::fflush(stdout);
    all_met_ = all_met_ && met;
  }
  bool all_met_ = true;
};

/// Quantile of unsorted values, `share` in 0..1; 0 when there are none.
inline double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto index = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  return values[index];
}

/// How much to do: 1 takes about a minute, `--long` more.
struct Effort {
  bool long_run = false;
  std::uint64_t seed = 1;  ///< of several robots' messages
};

void SimulatedLink(Figures& figures, const Effort& effort);  // sections of link_figures.cpp
void Commands(Figures& figures, const Effort& effort);       // command_figures.cpp
void Hostile(Figures& figures, const Effort& effort);        // attack_figures.cpp
void Stops(Figures& figures, const Effort& effort);          // stop_figures.cpp
void SharedChannel(Figures& figures, const Effort& effort);  // shared_figures.cpp
void Packets(Figures& figures, const Effort& effort);        // packet_figures.cpp
void SideBySide(Figures& figures);                           // size_figures.cpp
void Differences(Figures& figures);                          // delta_figures.cpp
/// A run with real processes.
struct RealTimeOptions {
  double seconds = 60;
  double bit_error_rate = 0;  ///< of the emulated line; stops follow each other more slowly then
};
/// Real processes on real ptys; `programs`: folder of priamos and priamos-radio.
void RealTime(Figures& figures, const std::string& programs, const RealTimeOptions& options);

}  // namespace priamos::bench
