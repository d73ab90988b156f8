// The robot's local motion beside others' on the same worlds with the same noise. `bench_rivals --help`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/config.hpp"
#include "test/bench/rivals/case.hpp"
#include "test/bench/rivals/drive.hpp"
#include "test/bench/rivals/grid_figures.hpp"
#include "test/bench/rivals/rivals.hpp"
#include "test/bench/rivals/table.hpp"
#include "world/world_config.hpp"

namespace {

using namespace priamos;

struct Options {
  std::uint64_t first = 1, last = 20;
  std::vector<std::string> families, drivers;
  std::string deployment = PRIAMOS_SOURCE_DIR "/config/sim";
  std::string tuning = PRIAMOS_SOURCE_DIR "/test/bench/rivals/tuning.toml";
  bool each = false, grids = false;
};

template <class T>
bool IsChosen(const std::vector<T>& chosen, const T& one) {
  return chosen.empty() || std::find(chosen.begin(), chosen.end(), one) != chosen.end();
}

void PrintDrive(const std::string& driver, std::uint64_t seed, const bench::Drive& drive) {
  fmt::print("    {} {}: {} after {:.1f} s, {} contacts, {} came, gap {:.1f} cm\n", driver, seed,
             drive.arrived ? "arrived" : "did not arrive", drive.seconds, drive.contacts, drive.came,
             100 * drive.min_gap_m);
}

std::vector<bench::Row> RowsOf(const Options& options, const std::string& family,
                               const world::RobotModel& model) {
  std::vector<bench::DriverKind> kinds;
  std::vector<bench::Row> rows;
  for (bench::DriverKind& kind : bench::AllDrivers(options.deployment, options.tuning)) {
    if (!IsChosen(options.drivers, kind.name)) continue;
    rows.push_back({kind.name, {}});
    kinds.push_back(std::move(kind));
  }
  for (std::uint64_t seed = options.first; seed <= options.last; ++seed) {
    const bench::Case task = bench::MakeCase(family, seed, options.deployment);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      const auto driver = kinds[i].make(task.order);
      rows[i].drives.push_back(bench::DriveCase(task, model, *driver, seed));
      if (options.each) PrintDrive(kinds[i].name, seed, rows[i].drives.back());
    }
  }
  return rows;
}

/// The robot's drives again, with grids that watch them.
void CompareGrids(const Options& options, const std::string& family, const world::RobotModel& model) {
  const auto kinds = bench::AllGrids();
  const bench::DriverKind robot = bench::AllDrivers(options.deployment, options.tuning).front();
  std::vector<bench::GridFigures> figures(kinds.size());
  for (std::uint64_t seed = options.first; seed <= options.last; ++seed) {
    const bench::Case task = bench::MakeCase(family, seed, options.deployment);
    bench::GridWatch watch(task, kinds, figures);
    const auto driver = robot.make(task.order);
    bench::DriveCase(task, model, *driver, seed,
                     [&](const bench::Heard& heard, const Pose2& at) { watch.See(heard, at); });
  }
  fmt::print("{}, the robot's drives, seeds {} to {}\n", family, options.first, options.last);
  bench::PrintGrids(kinds, figures);
}

void PrintDefeats(const std::vector<std::string>& defeats) {
  if (defeats.empty()) return fmt::print("beaten nowhere: in passes, contacts, time where both pass\n");
  fmt::print("beaten in:\n");
  for (const std::string& defeat : defeats) fmt::print("  {}\n", defeat);
}

void Run(const Options& options) {
#ifndef PRIAMOS_HAS_MRPT_NAV
  fmt::print("without MRPT's rows: libmrpt-nav-dev was not there when this was configured\n");
#endif
  const auto model = LoadConfig<world::WorldConfig>(options.deployment + "/world.toml").robot;
  std::vector<std::string> defeats;
  for (const bench::Family& family : bench::Families()) {
    if (!IsChosen(options.families, family.name)) continue;
    if (options.grids) {
      CompareGrids(options, family.name, model);
      continue;
    }
    const auto rows = RowsOf(options, family.name, model);
    bench::PrintTable(
        fmt::format("{}: {}; seeds {} to {}", family.name, family.what, options.first, options.last), rows);
    for (std::string& defeat : bench::Defeats(family.name, rows)) defeats.push_back(std::move(defeat));
  }
  if (!options.grids) PrintDefeats(defeats);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App cli(
      "The robot's local motion beside MRPT's and a dynamic window, on the same worlds with the same noise.");
  cli.add_option("--first", options.first, "seed");
  cli.add_option("--last", options.last, "seed");
  cli.add_option("--families", options.families, "which worlds (default: all)");
  cli.add_option("--drivers", options.drivers, "which drivers (default: all)");
  cli.add_option("--deployment", options.deployment, "folder of configurations");
  cli.add_option("--tuning", options.tuning, "file of the rivals' parameters");
  cli.add_flag("--grids", options.grids, "compare maps of echoes, not drivers");
  cli.add_flag("--each", options.each, "print every drive");
  CLI11_PARSE(cli, argc, argv);
  try {
    Run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_rivals: {}\n", error.what());
    return 2;
  }
}
