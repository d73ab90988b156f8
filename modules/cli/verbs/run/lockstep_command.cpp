#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "bus/own_types.hpp"
#include "bus/real_time_loop.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/lockstep/lockstep_run.hpp"
#include "cli/options/folder_options.hpp"
#include "cli/options/new_file.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/report/report_files.hpp"
#include "cli/verbs/run/commands.hpp"

namespace priamos::cli {
namespace {

struct LockstepOptions {
  LockstepRequest request;
  std::string deployment = "sim";
  int runs = 1;
  bool json = false;
  std::string json_file;  ///< none: standard output
  std::string log_root;
  bool verbose = false;
};

/// What a person reads; without a file standard output belongs to the JSON.
std::ostream& People(const LockstepOptions& options) {
  return options.json && options.json_file.empty() ? std::cerr : std::cout;
}

LockstepResult RunOne(const bus::Schema& schema, const LockstepOptions& options, std::uint64_t seed,
                      const bus::SignalWatch& signals) {
  LockstepRequest request = options.request;
  request.interrupted = [&signals] { return signals.Came(); };
  request.deployment = FolderOfDeployment(options.deployment);
  request.seed = seed;
  if (!options.log_root.empty())
    request.log_folder = (std::filesystem::path(options.log_root) / fmt::format("seed-{}", seed)).string();
  if (options.verbose)
    request.progress = [&options](Time t, const std::string& text) {
      People(options) << fmt::format("{:6.1f} s  {}", Seconds(t.time_since_epoch()), text) << std::endl;
    };
  if (request.log_folder) std::filesystem::create_directories(*request.log_folder);
  auto result = RunLockstep(schema, request);
  if (request.log_folder)
    WriteReport(result.record, result.summary, result.info, result.map_file, *request.log_folder);
  return result;
}

std::string Text(const HandSummary& hand) {
  const std::string honoured =
      hand.honoured() ? fmt::format("honoured {:.1f} %", 100 * *hand.honoured()) : "nothing to honour";
  return hand.longest_stop_s ? fmt::format("{}  longest stop {:.1f} s", honoured, *hand.longest_stop_s)
                             : honoured;
}

std::string Line(const LockstepResult& result) {
  const Summary& s = result.summary;
  if (s.hand)
    return fmt::format("seed {:<6} {}  contacts {}  gap {:.3f} m  {}  {:.0f} s  {:4.1f}x  {}", s.seed,
                       s.passed ? "passed" : "FAILED", s.contacts, s.min_gap_m, Text(*s.hand),
                       Seconds(result.duration), s.realtime_factor, s.passed ? "" : s.reason);
  if (s.explore)
    return fmt::format(
        "seed {:<6} {}  contacts {}  gap {:.3f} m  {}  {:.0f} m driven  {:.0f} s  {:4.1f}x  {}", s.seed,
        s.passed ? "passed" : "FAILED", s.contacts, s.min_gap_m, SeenText(*s.explore), s.explore->driven_m,
        s.duration_s, s.realtime_factor, s.passed ? "" : s.reason);
  return fmt::format("seed {:<6} {}  contacts {}  gap {:.3f} m  {}{:5.1f} s  {:4.1f}x  {}", s.seed,
                     s.passed ? "passed" : "FAILED", s.contacts, s.min_gap_m,
                     s.lateral_at_door_m ? fmt::format("lateral {:+.3f} m  ", *s.lateral_at_door_m) : "",
                     s.duration_s, s.realtime_factor, s.passed ? "" : s.reason);
}

void WriteJson(const std::string& file, const std::vector<Summary>& all) {
  if (file.empty()) return void(std::cout << SummariesAsJson(all, JsonForm::kOneLine) << std::endl);
  std::ofstream out(file);
  out << SummariesAsJson(all, JsonForm::kIndented) << "\n";
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

/// Checks that the files can be written: throws before the first run what would otherwise be found out after
/// the last one. Leaves the file that is there as it is.
void RequireWritable(const LockstepOptions& options) {
  if (!options.log_root.empty()) {
    std::filesystem::create_directories(options.log_root);
    if (access(options.log_root.c_str(), W_OK | X_OK) != 0)
      throw std::runtime_error(fmt::format("--logs: expected a folder that can be written, got \"{}\": {}",
                                           options.log_root, std::strerror(errno)));
  }
  if (!options.json_file.empty()) RequireFileOrNothing(options.json_file);
  if (!options.json_file.empty() && !std::ofstream(options.json_file, std::ios::app))
    throw std::runtime_error(fmt::format("--json: expected a file that can be written, got \"{}\": {}",
                                         options.json_file, std::strerror(errno)));
}

/// The runs; after a signal those that had come to their end.
std::vector<Summary> RunAll(const LockstepOptions& options) {
  const bus::SignalWatch signals;
  const bus::Schema schema = bus::OwnTypes();
  const auto shared = HoldShared();
  std::vector<Summary> all;
  try {
    for (int i = 0; i < options.runs; ++i) {
      const auto seed = options.request.seed + static_cast<std::uint64_t>(i);
      const auto result = RunOne(schema, options, seed, signals);
      all.push_back(result.summary);
      People(options) << Line(result) << std::endl;
    }
  } catch (const Interrupted& end) {
    People(options) << fmt::format("{}; {} of {} runs are done\n", end.what(), all.size(), options.runs);
  }
  return all;
}

/// One line about all runs, some of which may not have been driven.
std::string Together(const std::vector<Summary>& all, int runs) {
  int passed = 0, contacts = 0, corrections = 0, beyond = 0;
  double least_seen = 1;
  bool explored = false;
  for (const Summary& summary : all) {
    passed += summary.passed;
    contacts += summary.contacts;
    corrections += summary.corrections.count;
    beyond += summary.corrections.beyond_3_sigma;
    least_seen = std::min(least_seen, summary.explore ? summary.explore->seen : 1);
    explored = explored || summary.explore;
  }
  return fmt::format("{} of {} passed, {} contacts, {} of {} corrections beyond 3 sigmas{}", passed, runs,
                     contacts, beyond, corrections,
                     explored ? fmt::format(", seen {:.1f} % at least", 100 * least_seen) : "");
}

int Run(const LockstepOptions& options) {
  RequireWritable(options);
  const std::vector<Summary> all = RunAll(options);
  if (options.json) WriteJson(options.json_file, all);
  if (options.runs > 1)
    People(options) << Together(all, options.runs) << '\n';
  else if (!all.empty())
    PrintSummary(People(options), all.front());
  const auto passed = std::count_if(
      all.begin(), all.end(), [](const Summary& summary) { return summary.passed && summary.contacts == 0; });
  return passed == options.runs ? 0 : 1;
}

}  // namespace

void AddLockstepCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<LockstepOptions>();
  auto* verb = AddVerb(
      cli, "lockstep",
      "Run a scenario in one process on simulated time: same seed, same bytes, faster than real time.");
  verb->footer("Example: priamos lockstep --scenario door --seed 1 --runs 100 --json runs.json");
  verb->add_option("--scenario", options->request.scenario, "a file of the deployment's scenarios/")
      ->capture_default_str();
  verb->add_option("--seed", options->request.seed, "first seed")->capture_default_str();
  verb->add_option("--runs", options->runs, "number of runs, each with the next seed")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  auto* json =
      verb->add_option("--json", options->json_file,
                       "the summary (an array of them for several runs) into that file; without one, or "
                       "with -, to standard output");
  json->expected(0, 1);
  auto* logs = verb->add_option("--logs", options->log_root,
                                "write logs and report of each run into a folder per seed there");
  verb->add_flag("--pictures", options->request.keep_pictures,
                 "and the pictures that the head used, from which `priamos replay verify` can run it again")
      ->needs(logs);
  AddDeploymentOption(*verb, options->deployment);
  verb->add_flag("--verbose", options->verbose, "one line per phase");
  verb->callback([options, json, &exit_code] {
    options->json = json->count() > 0;
    if (options->json_file == "-") options->json_file.clear();
    exit_code = Run(*options);
  });
}

}  // namespace priamos::cli
