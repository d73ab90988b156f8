#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/log/csv_table.hpp"
#include "bus/log/log_export.hpp"
#include "bus/log/log_merge.hpp"
#include "bus/log/log_survey.hpp"
#include "bus/log/log_writer.hpp"
#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/log/commands.hpp"

namespace priamos::cli {
namespace {

constexpr int kDamaged = 1;
constexpr double kMostOffset_s = 1e10;  ///< three centuries

struct LogOptions {
  BusOptions bus;  ///< only its types
  SelectionOptions selection;
  std::string log, out, format, second;
  std::string prefix = "OFFBOARD_";
  double offset_s = NAN;
  bool json = false, force = false;
};

nlohmann::ordered_json ToJson(const std::string& file, const bus::LogSurvey& s) {
  auto channels = nlohmann::ordered_json::array();
  for (const auto& [name, c] : s.channels)
    channels.push_back({{"channel", name},
                        {"types", c.types},
                        {"events", c.events},
                        {"rate_hz", c.RateHz()},
                        {"bytes", c.bytes},
                        {"undecodable", c.undecodable},
                        {"first_utime", c.first_utime},
                        {"last_utime", c.last_utime}});
  return {{"file", file},
          {"size_bytes", s.size_bytes},
          {"events", s.events},
          {"first_utime", s.first_utime},
          {"last_utime", s.last_utime},
          {"skipped_bytes", s.skipped_bytes},
          {"damaged_places", s.damaged_places},
          {"missing_events", s.missing_numbers},
          {"undecodable", s.undecodable},
          {"channels", channels}};
}

std::string LossSentence(const bus::LogSurvey& s) {
  if (s.whole()) return "no damage, no event missing";
  return fmt::format("{} damaged places, {} bytes skipped, {} events missing", s.damaged_places,
                     s.skipped_bytes, s.missing_numbers);
}

void PrintSurvey(const std::string& file, const bus::LogSurvey& s) {
  const auto start = std::chrono::system_clock::time_point(std::chrono::microseconds(s.first_utime));
  std::cout << fmt::format("{}: {} events in {:.1f} s from {:%Y-%m-%d %H:%M:%S} UTC, {} bytes; {}\n", file,
                           s.events, static_cast<double>(s.last_utime - s.first_utime) * 1e-6,
                           std::chrono::time_point_cast<std::chrono::seconds>(start), s.size_bytes,
                           LossSentence(s));
  std::cout << fmt::format("{:<20} {:<28} {:>9} {:>9} {:>11} {:>11}\n", "channel", "type", "events",
                           "rate Hz", "bytes", "undecodable");
  for (const auto& [name, c] : s.channels)
    std::cout << fmt::format("{:<20} {:<28} {:>9} {:>9.2f} {:>11} {:>11}\n", name,
                             fmt::format("{}", fmt::join(c.types, " ")), c.events, c.RateHz(), c.bytes,
                             c.undecodable);
}

int Info(const LogOptions& options) {
  const bus::Schema schema = LoadTypes(options.bus);
  bus::LogReader reader(options.log);
  const auto survey = bus::Survey(reader, schema);
  if (options.json) {
    std::cout << ToJson(options.log, survey).dump() << "\n";
  } else {
    PrintSurvey(options.log, survey);
  }
  return survey.whole() ? 0 : kDamaged;
}

int Index(const LogOptions& options) {
  const bus::Schema schema = LoadTypes(options.bus);
  bus::LogReader reader(options.log);
  OutputFile out(options.out, options.log, options.force);
  if (!options.json) out.stream() << "offset,number,utime,channel,bytes,type\r\n";
  while (const auto event = reader.Next()) {
    const auto* type = schema.Find(bus::FingerprintOf(event->bytes.data(), event->bytes.size()));
    const std::string type_name = type ? type->full_name : "?";
    if (options.json) {
      out.stream() << nlohmann::ordered_json{{"offset", event->offset},      {"number", event->number},
                                             {"utime", event->utime},        {"channel", event->channel},
                                             {"bytes", event->bytes.size()}, {"type", type_name}}
                   << "\n";
      continue;
    }
    out.stream() << fmt::format("{},{},{},{},{},{}\r\n", event->offset, event->number, event->utime,
                                bus::QuotedCell(event->channel), event->bytes.size(), type_name);
  }
  return out.Close();
}

/// Checks the selection. Throws std::runtime_error when no event is selected: then nothing is to be written.
void RequireEvents(const LogOptions& options, const bus::LogSelection& selection) {
  bus::LogReader reader(options.log);
  while (const auto event = reader.Next())
    if (selection.Wants(event->utime, event->channel)) return;
  throw std::runtime_error(
      fmt::format("{}: expected events to copy, got none; {} is not written", options.log, options.out));
}

/// Ends the writing. Throws std::runtime_error when not all of it could be written.
void Finish(bus::LogWriter& writer, const std::string& file) {
  writer.Flush();
  if (!writer.good()) throw std::runtime_error(file + ": cannot be written: is the disk full?");
}

/// Verb `filter`: copies chosen events into another log.
int Filter(const LogOptions& options) {
  bus::LogReader reader(options.log);
  RequireNewFile(options.out, options.log, options.force);
  // Before the writer, which empties the file: a refusal leaves it as it was.
  const auto selection = SelectionOf(options.selection, options.log);
  RequireEvents(options, selection);
  bus::LogWriter writer(options.out);
  const auto copied = bus::CopyEvents(reader, selection, writer);
  Finish(writer, options.out);
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"events", copied},
                                        {"damaged_places", reader.damaged_places()},
                                        {"skipped_bytes", reader.skipped_bytes()}}
              << "\n";
    return 0;
  }
  std::cout << fmt::format("{}: {} events; {} damaged places with {} bytes left out\n", options.out, copied,
                           reader.damaged_places(), reader.skipped_bytes());
  return 0;
}

/// Verb `repair`: copies all whole events, with their numbers, into another log.
int Repair(const LogOptions& options) {
  bus::LogReader reader(options.log);
  RequireNewFile(options.out, options.log, options.force);
  RequireEvents(options, {});
  bus::LogWriter writer(options.out);
  const auto count = bus::RepairLog(reader, writer);
  Finish(writer, options.out);
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"events", count.events},
                                        {"damaged_places", reader.damaged_places()},
                                        {"skipped_bytes", reader.skipped_bytes()},
                                        {"numbers_not_increasing", count.not_increasing}}
              << "\n";
    return 0;
  }
  std::cout << fmt::format("{}: {} events with their numbers; {} damaged places with {} bytes left out\n",
                           options.out, count.events, reader.damaged_places(), reader.skipped_bytes());
  if (count.not_increasing > 0)
    std::cout << fmt::format(
        "{}: the numbers do not increase at {} events: damaged numbers, or joined logs\n", options.out,
        count.not_increasing);
  return 0;
}

int ReportExport(const LogOptions& options, const bus::ExportCount& count, const bus::LogReader& reader) {
  // Standard output may be taken by the messages themselves.
  const bool taken = options.out.empty() && options.format != "csv";
  if (options.json)
    (taken ? std::cerr : std::cout) << nlohmann::ordered_json{{"messages", count.written},
                                                              {"undecodable", count.undecodable},
                                                              {"damaged_places", reader.damaged_places()},
                                                              {"skipped_bytes", reader.skipped_bytes()}}
                                    << "\n";
  else
    std::cerr << fmt::format("{} messages; left out: {} undecodable, {} damaged places with {} bytes\n",
                             count.written, count.undecodable, reader.damaged_places(),
                             reader.skipped_bytes());
  if (count.written > 0 || count.undecodable == 0) return 0;
  std::cerr << options.log << ": no message could be decoded; name its .lcm folder with --types\n";
  return 1;
}

int Export(const LogOptions& options) {
  const bus::Schema schema = LoadTypes(options.bus);
  bus::LogReader reader(options.log);
  const auto selection = SelectionOf(options.selection, options.log);
  if (options.format == "csv") {
    if (options.out == "-") throw std::runtime_error("--out: expected a folder for csv, got \"-\"");
    const std::string folder =
        options.out.empty() ? std::filesystem::path(options.log).stem().string() + "-csv" : options.out;
    if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder) && !options.force)
      throw std::runtime_error(folder + ": expected a new folder, got one with files in it; --force uses it");
    return ReportExport(options, bus::ExportCsv(reader, schema, selection, folder), reader);
  }
  OutputFile out(options.out, options.log, options.force);
  const auto count = options.format == "mcap" ? bus::ExportMcap(reader, schema, selection, out.stream())
                                              : bus::ExportJsonLines(reader, schema, selection, out.stream());
  out.Close();
  return ReportExport(options, count, reader);
}

bus::ClockFit Clocks(const LogOptions& options, bus::LogReader& onboard, bus::LogReader& offboard) {
  if (!std::isnan(options.offset_s)) return {.offset_us = options.offset_s * 1e6};
  const bus::Schema schema = LoadTypes(options.bus);
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
void RequireTwoLogs(const LogOptions& options) {
  std::error_code none;
  if (!std::filesystem::equivalent(options.log, options.second, none)) return;
  throw std::runtime_error(fmt::format(
      "{} and {}: expected the logs of two buses, got the same file twice; next: name the log of the "
      "other bus",
      options.log, options.second));
}

int Merge(const LogOptions& options) {
  RequireTwoLogs(options);
  bus::LogReader onboard(options.log), offboard(options.second);
  RequireNewFile(options.out, options.log, options.force);
  RequireNewFile(options.out, options.second, options.force);
  const auto fit = Clocks(options, onboard, offboard);
  bus::LogWriter writer(options.out);
  const auto events = bus::MergeLogs(onboard, offboard, fit, options.prefix, writer);
  Finish(writer, options.out);
  const nlohmann::ordered_json json{{"events", events},
                                    {"offset_s", fit.offset_us * 1e-6},
                                    {"drift_ppm", fit.drift * 1e6},
                                    {"messages_in_both", fit.pairs},
                                    {"outliers", fit.outliers},
                                    {"spread_s", fit.spread_us * 1e-6},
                                    {"both_directions", fit.both_ways},
                                    {"asymmetry_s", fit.asymmetry_us * 1e-6}};
  if (options.json) {
    std::cout << json.dump() << "\n";
    return 0;
  }
  std::cout << fmt::format(
      "{}: {} events. Onboard clock = offboard clock {:+.6f} s {:+.1f} ppm, from {} messages in both logs "
      "({} outliers), median distance {:.1f} ms, {}\n",
      options.out, events, fit.offset_us * 1e-6, fit.drift * 1e6, fit.pairs, fit.outliers,
      fit.spread_us * 1e-3,
      fit.both_ways ? fmt::format("directions differ by {:.1f} ms", 2e-3 * std::abs(fit.asymmetry_us))
                    : "one direction only");
  return 0;
}

using Run = int (*)(const LogOptions&);

CLI::App* AddLogVerb(CLI::App& log, const char* name, const char* help, const char* example, Run run,
                     int& exit_code) {
  auto options = std::make_shared<LogOptions>();
  auto* verb = AddVerb(log, name, help);
  verb->footer(std::string("Example: ") + example);
  verb->add_option("log", options->log, "LCM log")->required()->check(CLI::ExistingFile);
  const std::string which = name;
  if (which == "merge")
    verb->add_option("offboard", options->second, "LCM log of the other bus")
        ->required()
        ->check(CLI::ExistingFile);
  if (which == "filter" || which == "repair" || which == "merge")
    verb->add_option("out", options->out, "new LCM log")->required();
  if (which == "export")
    verb->add_option("format", options->format, "csv, jsonl or mcap")
        ->required()
        ->check(CLI::IsMember({"csv", "jsonl", "mcap"}));
  if (which == "export" || which == "index")
    verb->add_option("--out", options->out, "file (csv: folder); none: standard output (csv: LOG-csv)");
  if (which == "merge") {
    verb->add_option("--prefix", options->prefix, "before the names of the offboard channels")
        ->capture_default_str();
    verb->add_option("--offset", options->offset_s,
                     "[s] onboard clock minus offboard clock, instead of an estimate")
        ->check(CLI::Range(-kMostOffset_s, kMostOffset_s));
  }
  if (which == "filter" || which == "export") AddSelectionOptions(*verb, options->selection);
  if (which != "filter" && which != "repair") AddTypesOption(*verb, options->bus);
  verb->add_flag("--json", options->json,
                 which == "export"
                     ? "the count machine-readable, on standard error when the messages go to standard output"
                     : "machine-readable");
  if (which != "info") verb->add_flag("--force", options->force, "replace an existing file");
  const bool to_stream = which == "export" || which == "index";
  verb->callback([options, run, to_stream, &exit_code] {
    if (to_stream && options->out == "-" && options->format != "csv") options->out.clear();
    exit_code = run(*options);
  });
  return verb;
}

}  // namespace

void AddLogCommand(CLI::App& cli, int& exit_code) {
  auto* log = AddVerb(cli, "log", "Record, play, look into, mend and convert LCM logs.");
  log->require_subcommand(1);
  AddLogVerb(*log, "info", "What is in a log, and what it lost (exit code 1 when damaged).",
             "priamos log info logs/run/onboard.lcmlog", Info, exit_code);
  AddLogVerb(*log, "index", "A line per event: where it is in the file, number, time, channel, type.",
             "priamos log index onboard.lcmlog --out onboard.csv", Index, exit_code);
  AddLogVerb(*log, "filter", "Some channels or some time of a log into another one.",
             "priamos log filter onboard.lcmlog drive.lcmlog --channels 'POSE,WHEEL_*' --from 10 --to 20",
             Filter, exit_code);
  AddLogVerb(*log, "export",
             "Decoded messages as tables, lines of JSON, or MCAP for Foxglove and Lichtblick.",
             "priamos log export onboard.lcmlog mcap --out onboard.mcap", Export, exit_code);
  AddLogVerb(*log, "repair",
             "All whole events of a damaged log into another one, with their numbers: what is missing stays "
             "visible.",
             "priamos log repair damaged.lcmlog mended.lcmlog", Repair, exit_code);
  AddLogVerb(
      *log, "merge",
      "An onboard and an offboard log of one run as one, in the onboard clock: messages that crossed the "
      "radio show how the two clocks differ.",
      "priamos log merge onboard.lcmlog offboard.lcmlog run.lcmlog", Merge, exit_code);
  AddLogRecordVerb(*log, exit_code);
  AddLogPlayVerb(*log, exit_code);
}

}  // namespace priamos::cli
