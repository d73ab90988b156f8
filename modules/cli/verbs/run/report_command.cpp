#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/pages/report_comparison.hpp"
#include "cli/pages/report_of_log.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/run/commands.hpp"
#include "common/config.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string a, b;
  std::string map, out;
  bool force = false, json = false;
};

/// The logs of a run's folder, or the log itself.
std::vector<std::string> LogsIn(const fs::path& path) {
  if (!fs::is_directory(path)) return {path.string()};
  std::vector<std::string> logs;
  for (const char* name : {"onboard.lcmlog", "offboard.lcmlog"})
    if (fs::exists(path / name)) logs.push_back((path / name).string());
  if (logs.empty())
    throw std::runtime_error(
        fmt::format("{}: expected onboard.lcmlog or offboard.lcmlog in it, got neither", path.string()));
  return logs;
}

void Write(const std::string& page, const std::string& file, const std::string& in, bool force) {
  OutputFile out(file, in, force);
  out.stream() << page;
  out.Close();
}

int ReportLog(const ReportOptions& options) {
  std::vector<std::string> logs = LogsIn(options.a);
  if (!options.b.empty()) logs.push_back(options.b);
  const std::string file = options.out.empty() ? "log-report.html" : options.out;
  for (const std::string& in : logs) RequireNewFile(file, in, options.force);
  if (!options.map.empty()) RequireNewFile(file, options.map, options.force);
  const RunRecord record = RecordOfLogs(logs);
  std::optional<GroundPlan> plan;
  if (!options.map.empty()) plan = LoadConfig<GroundPlan>(options.map);
  Write(LogPage(fs::path(options.a).lexically_normal().filename().string(), record, plan), file, logs.front(),
        options.force);
  if (options.json)
    std::cout << JsonLine({{"poses", std::int64_t(record.poses.size())},
                           {"alarms", std::int64_t(record.alarms.size())},
                           {"page", file}})
              << "\n";
  else
    std::cout << fmt::format("{} poses, {} alarms; the page: {}\n", record.poses.size(), record.alarms.size(),
                             file);
  return 0;
}

int Compare(const ReportOptions& options) {
  const ComparedRun a = LoadComparedRun(options.a), b = LoadComparedRun(options.b);
  const auto figures = CompareSummaries(a.summary, b.summary);
  const std::string file = options.out.empty() ? "comparison.html" : options.out;
  Write(ComparisonPage(a, b), file, "", options.force);
  const auto differ =
      std::count_if(figures.begin(), figures.end(), [](const ComparedFigure& f) { return f.a != f.b; });
  if (options.json)
    std::cout << JsonLine({{"figures", std::int64_t(figures.size())},
                           {"differ", std::int64_t(differ)},
                           {"page", file}})
              << "\n";
  else
    std::cout << fmt::format("{} of {} figures differ; the page: {}\n", differ, figures.size(), file);
  return 0;
}

int Report(const ReportOptions& options) {
  if (options.b.empty()) return ReportLog(options);
  const bool folders = fs::is_directory(options.a);
  if (folders != fs::is_directory(options.b))
    throw std::runtime_error(fmt::format("expected two folders of runs or two logs of one run, got {} and {}",
                                         options.a, options.b));
  if (std::error_code none; fs::equivalent(options.a, options.b, none))
    throw std::runtime_error(fmt::format("{} and {}: expected {}, got the same {} twice", options.a,
                                         options.b, folders ? "two runs" : "the logs of two buses",
                                         folders ? "folder" : "file"));
  return folders ? Compare(options) : ReportLog(options);
}

}  // namespace

void AddReportCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  auto* verb =
      AddVerb(cli, "report",
              "A log as a page: missions, map, alarms, looks, plots, radio; or two runs side by side.");
  verb->footer(
      "A log is one of the robot's bus, of the workstation's, or of both merged; a folder of a run has "
      "both.\n"
      "What a simulated run was judged by is in report.html of its folder.\n"
      "Example: priamos report day.lcmlog --map maps/door.toml\n"
      "Example: priamos report onboard.lcmlog offboard.lcmlog\n"
      "Example: priamos report logs/20260101-120000-door logs/20260102-120000-door");
  verb->add_option("a", options->a, "a log, or the folder of a run")->required()->check(CLI::ExistingPath);
  verb->add_option("b", options->b, "the log of the other bus, or the folder of another run")
      ->check(CLI::ExistingPath);
  verb->add_option("--map", options->map, "ground plan (TOML) to draw a log on")->check(CLI::ExistingFile);
  verb->add_option("--out", options->out,
                   "the page that is written; none: log-report.html, of two runs comparison.html");
  verb->add_flag("--force", options->force, "replace an existing file");
  CompleteVerb(*verb, options, Report, exit_code, "what was found, machine-readable");
}

}  // namespace priamos::cli
