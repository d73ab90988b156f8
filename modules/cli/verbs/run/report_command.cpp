#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "cli/options/log_options.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/pages/log_map.hpp"
#include "cli/pages/report_comparison.hpp"
#include "cli/pages/report_of_log.hpp"
#include "cli/terminal/json_line.hpp"
#include "cli/verbs/run/commands.hpp"
#include "common/config.hpp"
#include "common/drawing/raster.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string a, b;
  std::string map, out, time_lapse;
  double every_s = 10;
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

/// The map of a log as it grew, a picture for each step, all of one extent: 0010.png after 10 s. Returns how
/// many there are.
std::size_t WriteTimeLapse(const ReportOptions& options, const RunRecord& record,
                           const std::optional<GroundPlan>& plan) {
  if (record.poses.empty())
    throw std::runtime_error("--time-lapse: expected a log with poses, got one without");
  const fs::path folder = options.time_lapse;
  if (fs::exists(folder) && !(fs::is_directory(folder) && (options.force || fs::is_empty(folder))))
    throw std::runtime_error(
        fmt::format("--time-lapse: expected a new folder, got \"{}\", where something is; next: --force",
                    folder.string()));
  fs::create_directories(folder);
  const Extent extent = ExtentOfLog(record, plan);
  const std::int64_t begin = record.poses.front().utime, end = record.poses.back().utime;
  const auto step_us = static_cast<std::int64_t>(options.every_s * 1e6);
  std::size_t n = 0;
  for (std::int64_t at = begin + step_us; at < end + step_us; at += step_us, ++n) {
    const std::string file =
        (folder / fmt::format("{:04d}.png", std::llround(double(at - begin) * 1e-6))).string();
    OutputFile out(file, "", options.force);
    out.stream() << drawing::ToPng(drawing::Paint(DrawLogMap(MapRecordUntil(record, at), plan, extent)));
    out.Close();
  }
  return n;
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
  const std::size_t pictures = options.time_lapse.empty() ? 0 : WriteTimeLapse(options, record, plan);
  if (pictures > 0 && !options.json)
    std::cout << fmt::format("{} pictures in {}\n", pictures, options.time_lapse);
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
      "Example: priamos report onboard.lcmlog offboard.lcmlog --time-lapse pictures --every 20\n"
      "Example: priamos report logs/20260101-120000-door logs/20260102-120000-door");
  verb->add_option("a", options->a, "a log, or the folder of a run")->required()->check(CLI::ExistingPath);
  verb->add_option("b", options->b, "the log of the other bus, or the folder of another run")
      ->check(CLI::ExistingPath);
  verb->add_option("--map", options->map, "ground plan (TOML) to draw a log on")->check(CLI::ExistingFile);
  verb->add_option("--out", options->out,
                   "the page that is written; none: log-report.html, of two runs comparison.html");
  verb->add_option("--time-lapse", options->time_lapse,
                   "a folder for pictures of a log's map as it grew: 0010.png after 10 s");
  verb->add_option("--every", options->every_s, "[s] between two pictures; 10 if not given")
      ->check(CLI::Range(1.0, 36000.0));
  verb->add_flag("--force", options->force, "replace an existing file");
  CompleteVerb(*verb, options, Report, exit_code, "what was found, machine-readable");
}

}  // namespace priamos::cli
