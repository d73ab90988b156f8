#include "bus/log/log_merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/log/type_texts.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/log_options.hpp"
#include "cli/verbs/log/commands.hpp"
#include "cli/verbs/log/log_verb.hpp"

namespace priamos::cli {
namespace {

constexpr double kMostOffset_s = 1e10;  ///< three centuries

struct MergeOptions : LogOptions {
  std::string second;
  std::string prefix = "OFFBOARD_";
  double offset_s = NAN;
};

bus::ClockFit Clocks(const MergeOptions& options, bus::LogReader& onboard, bus::LogReader& offboard) {
  if (!std::isnan(options.offset_s)) return {.offset_us = options.offset_s * 1e6};
  const bus::Schema schema = LoadTypes(options.bus.types);
  const auto fit = bus::FitClocks(bus::FindStampPairs(onboard, offboard, schema));
  if (!fit)
    throw std::runtime_error(
        fmt::format("{} and {}: expected messages that crossed the radio, got none that are in both; are "
                    "they logs of one "
                    "run? --offset SECONDS joins them anyway",
                    options.log, options.second));
  return *fit;
}

/// Two names may lead to one file.
void RequireTwoLogs(const MergeOptions& options) {
  std::error_code none;
  if (!std::filesystem::equivalent(options.log, options.second, none)) return;
  throw std::runtime_error(fmt::format(
      "{} and {}: expected the logs of two buses, got the same file twice; next: name the log of the "
      "other bus",
      options.log, options.second));
}

/// What no reader takes for a channel would be lost in the new log.
void RequireNamesFit(const MergeOptions& options) {
  for (bus::LogReader reader(options.second); const auto event = reader.Next();) {
    const std::string name = options.prefix + event->channel;
    if (!bus::IsLogChannel(name))
      throw std::runtime_error(fmt::format(
          "--prefix {}: expected a name of 1 to 255 printable ASCII characters, got one of {} for "
          "{} of {}",
          options.prefix, name.size(), event->channel, options.second));
  }
}

/// Seconds that the times of `log` may be moved by and stay such that readers take them.
std::pair<double, double> RoomOf(const std::string& log) {
  std::int64_t least = 0, most = 0;
  bool first = true;
  for (bus::LogReader reader(log); const auto event = reader.Next(); first = false) {
    least = first ? event->utime : std::min(least, event->utime);
    most = first ? event->utime : std::max(most, event->utime);
  }
  constexpr std::int64_t kEdge = bus::log_format::kLargestTime;
  return {static_cast<double>(-kEdge - least) * 1e-6, static_cast<double>(kEdge - most) * 1e-6};
}

/// A time that no reader takes would be lost in the new log, with its event.
void RequireTimesFit(const MergeOptions& options, const bus::ClockFit& fit) {
  for (bus::LogReader reader(options.second); const auto event = reader.Next();) {
    if (bus::IsWritable(fit.ToA(event->utime), "A", 0)) continue;
    const auto [least, most] = RoomOf(options.second);
    throw std::runtime_error(
        fmt::format("--offset: expected {:.0f} to {:.0f} s, with which the times of {} stay before the year "
                    "2255, got {:.0f}",
                    std::ceil(least), std::floor(most), options.second, fit.offset_us * 1e-6));
  }
}

/// The second log is read only when the first has nothing.
void RequireEventsOfEither(const MergeOptions& options) {
  const auto is_message = [](const bus::LogEvent& event) { return !bus::IsTypeText(event.bytes); };
  if (HasEvent(options.log, is_message)) return;
  RequireEvents(options.second, options.out, "merge", is_message);
}

/// The clock of the offboard log in that of the onboard one.
bus::ClockFit FitBoth(const MergeOptions& options) {
  bus::LogReader onboard(options.log), offboard(options.second);
  return Clocks(options, onboard, offboard);
}

/// Says which of the logs had damage that is not in the new one.
void ReportDamage(const std::string& log, const bus::LogReader& reader) {
  if (reader.damaged_places() > 0) std::cerr << log << ": " << LeftOut(reader) << "\n";
}

int Merge(const MergeOptions& options) {
  RequireTwoLogs(options);
  RequireNewFile(options.out, options.log, options.force);
  RequireNewFile(options.out, options.second, options.force);
  RequireNamesFit(options);
  RequireEventsOfEither(options);
  const auto fit = FitBoth(options);
  RequireTimesFit(options, fit);
  NewFile place(options.out);
  bus::LogWriter writer(place.written());
  bus::LogReader onboard(options.log), offboard(options.second);
  const auto events = bus::MergeLogs(onboard, offboard, fit, options.prefix, writer);
  Finish(writer, options.out, place);
  ReportDamage(options.log, onboard);
  ReportDamage(options.second, offboard);
  const nlohmann::ordered_json json{{"events", events},
                                    {"offset_s", fit.offset_us * 1e-6},
                                    {"drift_ppm", fit.drift * 1e6},
                                    {"messages_in_both", fit.pairs},
                                    {"outliers", fit.outliers},
                                    {"spread_s", fit.spread_us * 1e-6},
                                    {"both_directions", fit.both_ways},
                                    {"asymmetry_s", fit.asymmetry_us * 1e-6},
                                    {"damaged_places", onboard.damaged_places() + offboard.damaged_places()},
                                    {"skipped_bytes", onboard.skipped_bytes() + offboard.skipped_bytes()}};
  if (options.json) {
    std::cout << json.dump() << "\n";
    return 0;
  }
  std::cout << fmt::format(
      "{}: {}. Onboard clock = offboard clock {:+.6f} s {:+.1f} ppm, from {} in both logs "
      "({}), median distance {:.1f} ms, {}\n",
      options.out, Counted(events, "event"), fit.offset_us * 1e-6, fit.drift * 1e6,
      Counted(fit.pairs, "message"), Counted(fit.outliers, "outlier"), fit.spread_us * 1e-3,
      fit.both_ways ? fmt::format("directions differ by {:.1f} ms", 2e-3 * std::abs(fit.asymmetry_us))
                    : "one direction only");
  return 0;
}

}  // namespace

void AddLogMergeVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<MergeOptions>();
  auto* verb = AddLogVerb(log,
                          {.name = "merge",
                           .help = "An onboard and an offboard log of one run as one, in the onboard clock: "
                                   "messages that crossed the "
                                   "radio show how the two clocks differ.",
                           .example = "priamos log merge onboard.lcmlog offboard.lcmlog run.lcmlog"},
                          *options);
  verb->add_option("offboard", options->second, "LCM log of the other bus")
      ->required()
      ->check(CLI::ExistingFile);
  verb->add_option("out", options->out, "new LCM log")->required();
  verb->add_option("--prefix", options->prefix, "before the names of the offboard channels")
      ->capture_default_str();
  verb->add_option("--offset", options->offset_s,
                   "[s] onboard clock minus offboard clock, instead of an estimate")
      ->check(CLI::Range(-kMostOffset_s, kMostOffset_s));
  AddTypesOption(*verb, options->bus.types);
  AddOutputFlags(*verb, *options);
  verb->callback([options, &exit_code] { exit_code = Merge(*options); });
}

}  // namespace priamos::cli
