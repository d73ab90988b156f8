#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/log/csv_table.hpp"
#include "bus/log/log_reader.hpp"
#include "bus/log/log_survey.hpp"
#include "bus/log/type_texts.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/log_options.hpp"
#include "cli/verbs/log/commands.hpp"
#include "cli/verbs/log/log_verb.hpp"

namespace priamos::cli {
namespace {

constexpr int kDamaged = 1;

nlohmann::ordered_json DamageAsJson(const bus::LogSurvey& s) {
  if (!s.first_damage) return nullptr;
  return {{"offset", s.first_damage->offset}, {"what", s.first_damage->what}};
}

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
          {"first_damage", DamageAsJson(s)},
          {"missing_events", s.missing_numbers},
          {"undecodable", s.undecodable},
          {"channels", channels}};
}

std::string LossSentence(const bus::LogSurvey& s) {
  if (s.whole()) return "no damage, no event missing";
  return fmt::format("{}, {} skipped, {} missing{}", Counted(s.damaged_places, "damaged place"),
                     Counted(s.skipped_bytes, "byte"), Counted(s.missing_numbers, "event"),
                     FirstDamage(s.first_damage, "; "));
}

/// From when to when; an empty log is of no time.
std::string TimeSentence(const bus::LogSurvey& s) {
  if (s.events == 0) return "";
  const auto start = std::chrono::system_clock::time_point(std::chrono::microseconds(s.first_utime));
  return fmt::format(" in {:.1f} s from {:%Y-%m-%d %H:%M:%S} UTC",
                     static_cast<double>(s.last_utime - s.first_utime) * 1e-6,
                     std::chrono::time_point_cast<std::chrono::seconds>(start));
}

void PrintSurvey(const std::string& file, const bus::LogSurvey& s) {
  std::cout << fmt::format("{}: {}{}, {}; {}\n", file, Counted(s.events, "event"), TimeSentence(s),
                           Counted(s.size_bytes, "byte"), LossSentence(s));
  std::cout << fmt::format("{:<20} {:<28} {:>9} {:>9} {:>11} {:>11}\n", "channel", "type", "events",
                           "rate Hz", "bytes", "undecodable");
  for (const auto& [name, c] : s.channels)
    std::cout << fmt::format("{:<20} {:<28} {:>9} {:>9.2f} {:>11} {:>11}\n", name,
                             fmt::format("{}", fmt::join(c.types, " ")), c.events, c.RateHz(), c.bytes,
                             c.undecodable);
}

int Info(const LogOptions& options) {
  const bus::Schema schema = LoadTypes(options.bus.types);
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
  const bus::Schema schema = LoadTypes(options.bus.types);
  bus::LogReader reader(options.log);
  OutputFile out(options.out, options.log, options.force);
  if (out.named())
    RequireEvents(options.log, options.out, "index", [](const bus::LogEvent&) { return true; });
  if (!options.json) out.stream() << "offset,number,utime,channel,bytes,type\r\n";
  bus::LogTypes types(&schema);
  while (const auto event = reader.Next()) {
    types.Take(event->bytes);
    const auto* type = types.Of(event->bytes);
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
  out.Close();
  if (reader.damaged_places() == 0) return 0;
  std::cerr << options.log << ": " << LeftOut(reader) << "\n";
  return kDamaged;
}

}  // namespace

void AddLogInfoVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<LogOptions>();
  auto* verb = AddLogVerb(log,
                          {.name = "info",
                           .help = "What is in a log, and what it lost (exit code 1 when damaged).",
                           .example = "priamos log info logs/run/onboard.lcmlog"},
                          *options);
  AddTypesOption(*verb, options->bus.types);
  verb->add_flag("--json", options->json, "machine-readable");
  verb->callback([options, &exit_code] { exit_code = Info(*options); });
}

void AddLogIndexVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<LogOptions>();
  auto* verb =
      AddLogVerb(log,
                 {.name = "index",
                  .help = "A line per event: where it is in the file, number, time, channel, type (exit "
                          "code 1 when damaged).",
                  .example = "priamos log index onboard.lcmlog --out onboard.csv"},
                 *options);
  verb->add_option("--out", options->out, "file; none: standard output");
  AddTypesOption(*verb, options->bus.types);
  AddOutputFlags(*verb, *options);
  verb->callback([options, &exit_code] {
    if (options->out == "-") options->out.clear();
    exit_code = Index(*options);
  });
}

}  // namespace priamos::cli
