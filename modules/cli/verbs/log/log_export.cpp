#include "bus/log/log_export.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bus/log/log_reader.hpp"
#include "bus/log/type_texts.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/log_options.hpp"
#include "cli/verbs/log/commands.hpp"
#include "cli/verbs/log/log_verb.hpp"
#include "common/config.hpp"
#include "common/ground_plan.hpp"
#include "common/input/regular_file.hpp"
#include "console/foxglove/scene.hpp"
#include "console/foxglove/scene_schemas.hpp"

namespace priamos::cli {
namespace {

struct ExportOptions : LogOptions {
  SelectionOptions selection;
  std::string format, map;
  bool plain = false;
};

/// Why nothing could be decoded, and what helps.
std::string WhyNothing(const ExportOptions& options, const bus::ExportCount& count) {
  if (count.unknown == 0) return "all messages are damaged: first " + count.first_refused;
  if (options.bus.types.empty()) return "no message could be decoded; name its .lcm folder with --types";
  return fmt::format(
      "no message could be decoded: expected a type that --types or the log defines, got {}; next: name the "
      "folder that defines it as well, by one more --types",
      count.first_unknown);
}

int ReportExport(const ExportOptions& options, const bus::ExportCount& count, const bus::LogReader& reader) {
  // Standard output may be taken by the messages themselves.
  const bool taken = options.out.empty() && options.format != "csv";
  if (options.json)
    (taken ? std::cerr : std::cout) << nlohmann::ordered_json{{"messages", count.written},
                                                              {"undecodable", count.undecodable},
                                                              {"damaged_places", reader.damaged_places()},
                                                              {"skipped_bytes", reader.skipped_bytes()}}
                                    << "\n";
  else
    std::cerr << fmt::format("{}; {} undecodable; {}\n", Counted(count.written, "message"), count.undecodable,
                             LeftOut(reader));
  if (count.written > 0 || count.undecodable == 0) return 0;
  std::cerr << options.log << ": " << WhyNothing(options, count) << "\n";
  return 1;
}

/// The robot as the 3-D panels of Foxglove and Lichtblick draw it; before its first message the plan.
bus::Derivation Drawn(const ExportOptions& options) {
  if (options.plain) return {};
  auto scene = std::make_shared<console::Scene>(kDrawnBody);
  auto plan = std::make_shared<std::optional<GroundPlan>>();
  if (!options.map.empty()) *plan = LoadConfig<GroundPlan>(options.map);
  const auto derive = [scene, plan](const std::string& channel, const nlohmann::ordered_json& message,
                                    std::int64_t utime) {
    const Time time = FromUtime(utime);
    auto drawn = scene->Hear(channel, message, time);
    if (const auto first = std::exchange(*plan, std::nullopt))
      drawn.insert(drawn.begin(), console::Scene::Plan(*first, time));
    std::vector<bus::DerivedMessage> derived;
    for (const auto& one : drawn)
      derived.push_back(
          {std::string(one.topic), std::string(console::Scene::SchemaOf(one.topic)), one.json.dump()});
    return derived;
  };
  return {derive, [](const std::string& name) { return console::SceneSchema(name); }};
}

void RequireMessages(const ExportOptions& options, const bus::LogSelection& selection,
                     const std::string& out) {
  RequireEvents(options.log, out, "export", [&](const bus::LogEvent& event) {
    return selection.Wants(event.utime, event.channel) && !bus::IsTypeText(event.bytes);
  });
}

void RequireFolderOrNothing(const std::string& folder) {
  if (!std::filesystem::exists(folder) || std::filesystem::is_directory(folder)) return;
  const std::string got = OtherThanAFileAt(folder);
  throw std::runtime_error(
      fmt::format("{}: expected a new folder, got {}", folder, got.empty() ? "a file" : got));
}

int Export(const ExportOptions& options) {
  const bus::Schema schema = LoadTypes(options.bus.types);
  bus::LogReader reader(options.log);
  const auto selection = SelectionOf(options.selection, options.log);
  if (options.format == "csv") {
    if (options.out == "-") throw std::runtime_error("--out: expected a folder for csv, got \"-\"");
    const std::string folder =
        options.out.empty() ? std::filesystem::path(options.log).stem().string() + "-csv" : options.out;
    RequireFolderOrNothing(folder);
    if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder) && !options.force)
      throw std::runtime_error(folder + ": expected a new folder, got one with files in it; --force uses it");
    RequireMessages(options, selection, folder);
    return ReportExport(options, bus::ExportCsv(reader, schema, selection, folder), reader);
  }
  OutputFile out(options.out, options.log, options.force);
  if (out.named()) RequireMessages(options, selection, options.out);
  const auto count = options.format == "mcap"
                         ? bus::ExportMcap(reader, schema, selection, out.stream(), Drawn(options))
                         : bus::ExportJsonLines(reader, schema, selection, out.stream());
  // What could not be decoded at all replaces no file.
  if (count.written > 0 || count.undecodable == 0) out.Close();
  return ReportExport(options, count, reader);
}

}  // namespace

void AddLogExportVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  auto* verb =
      AddLogVerb(log,
                 {.name = "export",
                  .help = "Decoded messages as tables, lines of JSON, or MCAP for Foxglove and Lichtblick.",
                  .example = "priamos log export onboard.lcmlog mcap --out onboard.mcap"},
                 *options);
  verb->add_option("format", options->format, "csv, jsonl or mcap")
      ->required()
      ->check(CLI::IsMember({"csv", "jsonl", "mcap"}));
  verb->add_option("--out", options->out, "file (csv: folder); none: standard output (csv: LOG-csv)");
  verb->add_option("--map", options->map, "ground plan (TOML), drawn in the 3-D panel of an mcap")
      ->check(CLI::ExistingFile);
  verb->add_flag("--plain", options->plain, "mcap: only the channels of the log, nothing for the 3-D panel");
  AddSelectionOptions(*verb, options->selection);
  AddTypesOption(*verb, options->bus.types);
  AddOutputFlags(*verb, *options,
                 "the count machine-readable, on standard error when the messages go to standard output");
  verb->callback([options, &exit_code] {
    if (options->out == "-" && options->format != "csv") options->out.clear();
    exit_code = Export(*options);
  });
}

}  // namespace priamos::cli
