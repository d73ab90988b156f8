#include "cli/verbs/mrpt/log_mrpt.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/options/counted.hpp"
#include "cli/options/log_options.hpp"
#include "cli/verbs/log/log_verb.hpp"
#include "cli/verbs/mrpt/mrpt_run.hpp"
#include "common/robot/body_size.hpp"

namespace priamos::cli {
namespace {

struct MrptOptions : LogOptions {
  SelectionOptions selection;
};

bool IsSimplemap(const std::string& file) {
  return file.ends_with(".simplemap");
}

int ToMrpt(const MrptOptions& options) {
  if (!IsSimplemap(options.out) && !options.out.ends_with(".rawlog"))
    throw std::runtime_error(
        fmt::format("out: expected a file called *.rawlog or *.simplemap, got \"{}\"", options.out));
  RequireNewFile(options.out, options.log, options.force);
  bus::LogReader reader(options.log);
  const auto selection = SelectionOf(options.selection, options.log);
  const Eigen::Vector2d footprint_m(kDrawnBody.length_m, kDrawnBody.width_m);
  NewFile file(options.out);
  const MrptCount count = (IsSimplemap(options.out) ? WriteSimplemap : WriteRawlog)(
      reader, selection, footprint_m, file.written());
  if (count.cycles == 0)
    throw std::runtime_error(options.log +
                             ": expected a log of the robot's bus, got one without sonar cycles" +
                             (IsSimplemap(options.out) ? " and poses" : ""));
  file.Keep();
  if (options.json)
    std::cout << nlohmann::ordered_json{{"cycles", count.cycles},
                                        {"places", count.places},
                                        {"undecodable", count.refused},
                                        {"skipped_bytes", reader.skipped_bytes()}}
              << "\n";
  else
    std::cout << fmt::format("{}: {} of the sonars, {} of the base; {} undecodable; {}\n", options.out,
                             Counted(count.cycles, "cycle"), Counted(count.places, "place"), count.refused,
                             LeftOut(reader));
  return 0;
}

}  // namespace

void AddLogMrptVerb(CLI::App& log, int& exit_code) {
  auto options = std::make_shared<MrptOptions>();
  auto* verb =
      AddLogVerb(log,
                 {.name = "mrpt",
                  .help = "The sonars and the base of a run as MRPT's tools read them: a .rawlog, or "
                          "a .simplemap with the poses.",
                  .example = "priamos log mrpt onboard.lcmlog run.rawlog"},
                 *options);
  verb->add_option("out", options->out, "*.rawlog or *.simplemap")->required();
  AddSelectionOptions(*verb, options->selection);
  AddOutputFlags(*verb, *options);
  verb->callback([options, &exit_code] { exit_code = ToMrpt(*options); });
}

}  // namespace priamos::cli
