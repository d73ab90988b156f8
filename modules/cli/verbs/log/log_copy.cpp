#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "bus/log/log_export.hpp"
#include "bus/log/log_reader.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/log/type_texts.hpp"
#include "cli/options/counted.hpp"
#include "cli/options/log_options.hpp"
#include "cli/verbs/log/commands.hpp"
#include "cli/verbs/log/log_verb.hpp"

namespace priamos::cli {
namespace {

struct CopyOptions : LogOptions {
  SelectionOptions selection;
};

/// Verb `filter`: copies chosen events into another log.
int Filter(const CopyOptions& options) {
  bus::LogReader reader(options.log);
  RequireNewFile(options.out, options.log, options.force);
  // Before the writer, which empties the file: a refusal leaves it as it was.
  const auto selection = SelectionOf(options.selection, options.log);
  RequireEvents(options.log, options.out, "copy", [&](const bus::LogEvent& event) {
    return selection.Wants(event.utime, event.channel) && !bus::IsTypeText(event.bytes);
  });
  NewFile place(options.out);
  bus::LogWriter writer(place.written());
  const auto copied = bus::CopyEvents(reader, selection, writer);
  Finish(writer, options.out, place);
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"events", copied},
                                        {"damaged_places", reader.damaged_places()},
                                        {"skipped_bytes", reader.skipped_bytes()}}
              << "\n";
    return 0;
  }
  std::cout << fmt::format("{}: {}; {}\n", options.out, Counted(copied, "event"), LeftOut(reader));
  return 0;
}

/// Verb `repair`: copies all whole events, with their numbers, into another log.
int Repair(const CopyOptions& options) {
  bus::LogReader reader(options.log);
  RequireNewFile(options.out, options.log, options.force);
  RequireEvents(options.log, options.out, "copy", [](const bus::LogEvent&) { return true; });
  NewFile place(options.out);
  bus::LogWriter writer(place.written());
  const auto count = bus::RepairLog(reader, writer);
  Finish(writer, options.out, place);
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"events", count.events},
                                        {"damaged_places", reader.damaged_places()},
                                        {"skipped_bytes", reader.skipped_bytes()},
                                        {"numbers_not_increasing", count.not_increasing}}
              << "\n";
    return 0;
  }
  std::cout << fmt::format("{}: {} with their numbers; {}\n", options.out, Counted(count.events, "event"),
                           LeftOut(reader));
  if (count.not_increasing > 0)
    std::cout << fmt::format("{}: the numbers do not increase at {}: damaged numbers, or joined logs\n",
                             options.out, Counted(count.not_increasing, "event"));
  return 0;
}

}  // namespace

void AddLogFilterVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<CopyOptions>();
  auto* verb = AddLogVerb(
      log,
      {.name = "filter",
       .help = "Some channels or some time of a log into another one.",
       .example =
           "priamos log filter onboard.lcmlog drive.lcmlog --channels 'POSE,WHEEL_*' --from 10 --to 20"},
      *options);
  verb->add_option("out", options->out, "new LCM log")->required();
  AddSelectionOptions(*verb, options->selection);
  AddOutputFlags(*verb, *options);
  verb->callback([options, &exit_code] { exit_code = Filter(*options); });
}

void AddLogRepairVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<CopyOptions>();
  auto* verb = AddLogVerb(
      log,
      {.name = "repair",
       .help =
           "All whole events of a damaged log into another one, with their numbers: what is missing stays "
           "visible.",
       .example = "priamos log repair damaged.lcmlog mended.lcmlog"},
      *options);
  verb->add_option("out", options->out, "new LCM log")->required();
  AddOutputFlags(*verb, *options);
  verb->callback([options, &exit_code] { exit_code = Repair(*options); });
}

}  // namespace priamos::cli
