// The exploration alone on true floors: how far it drives, and what for. `bench_floors --help`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "cli/floor/floor_tour.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/verbs/world/generated_files.hpp"
#include "common/config.hpp"
#include "planner/planner_config.hpp"
#include "test/bench/floors/floor_drive.hpp"
#include "world/generation.hpp"

namespace {

using namespace priamos;

struct Options {
  std::uint64_t first = 1, last = 1;
  std::string floor = "storey", into = std::filesystem::temp_directory_path() / "bench_floors",
              deployment = PRIAMOS_SOURCE_DIR "/config/sim";
  bool legs = false;
  std::vector<std::string> settings;
  planner::ExploreMissionConfig config;
};

cli::TrueWorld WorldOf(const Options& options, std::uint64_t seed) {
  if (options.floor != "storey")
    return cli::LoadTrueWorld(options.deployment, cli::LoadScenario(options.deployment, options.floor), seed);
  const std::string folder = fmt::format("{}/storey-{}", options.into, seed);
  std::filesystem::create_directories(options.into);
  const auto files = cli::WriteGenerated(world::Generate("storey", seed), "storey", seed,
                                         cli::GeneratedTask::kExplore, options.deployment, folder);
  return cli::LoadTrueWorld(folder, cli::LoadScenario(folder, files.scenario), seed);
}

/// One line for each leg: what it cost, and what it brought.
void PrintLegs(const bench::FloorDrive& drive) {
  const double all_m2 = drive.floor().reachable_m2();
  for (const bench::Leg& leg : drive.legs())
    fmt::print(
        "  {:6.1f} m + {:5.1f} m: {:5.1f} m2, {:5.1f} % seen; border of {:4.1f} m at ({:.1f}, {:.1f}){}\n",
        leg.from_m, leg.to_m - leg.from_m, all_m2 * (leg.seen_to - leg.seen_from), 100 * leg.seen_to,
        leg.length_m, leg.target.x(), leg.target.y(), leg.again ? ", again" : "");
}

/// Returns driven by the best tour.
double RunOn(const Options& options, std::uint64_t seed) {
  const Eigen::Vector2d start(1.5, 0);
  const cli::TrueWorld world = WorldOf(options, seed);
  bench::FloorDrive drive(world, start, seed, options.config.choice);
  const double tour_m = cli::TourOf(drive.floor(), start).length_m;
  drive.Run(options.config.rounds);
  if (options.legs) PrintLegs(drive);
  double barren_m = 0;
  for (const bench::Leg& leg : drive.legs())
    if (drive.floor().reachable_m2() * (leg.seen_to - leg.seen_from) < 0.5) barren_m += leg.to_m - leg.from_m;
  fmt::print(
      "{} {}: {:.0f} m2, seen {:.1f} %, driven {:.0f} m, tour {:.0f} m: {:.2f} times; 90 % at {:.2f}, 98 % "
      "at "
      "{:.2f}; {:.0f} m in legs that saw less than 0.5 m2; {} legs, {:.0f} ms each to choose\n",
      options.floor, seed, drive.floor().reachable_m2(), 100 * drive.floor().seen(), drive.driven_m(), tour_m,
      drive.driven_m() / tour_m, drive.DrivenUntil(0.9) / tour_m, drive.DrivenUntil(0.98) / tour_m, barren_m,
      drive.legs().size(), 1e3 * drive.choosing_s() / double(std::max<std::size_t>(1, drive.legs().size())));
  for (const auto& left : drive.exploration().left())
    if (options.legs)
      fmt::print("  left: {:.1f} m at ({:.1f}, {:.1f}): {}\n", left.length_m, left.middle.x(),
                 left.middle.y(), left.reason);
  std::fflush(stdout);
  return drive.driven_m() / tour_m;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App cli("The exploration alone, without robot, radio and drift: how far it drives, and what for.");
  cli.add_option("--first", options.first, "seed");
  cli.add_option("--last", options.last, "seed");
  cli.add_option("--floor", options.floor, "storey (made up from the seed), or a scenario of the deployment");
  cli.add_option("--deployment", options.deployment, "folder of configurations");
  cli.add_option("--into", options.into, "folder of the floors that are made up")->capture_default_str();
  cli.add_option("--set", options.settings,
                 "KEY=VALUE of the planner's configuration, such as explore.rounds=2");
  cli.add_flag("--legs", options.legs, "print each");
  CLI11_PARSE(cli, argc, argv);
  options.config =
      LoadConfig<planner::PlannerConfig>(ConfigSource{options.deployment + "/planner.toml", options.settings})
          .explore;
  double sum = 0;
  for (std::uint64_t seed = options.first; seed <= options.last; ++seed) sum += RunOn(options, seed);
  fmt::print("mean of {}: {:.2f} times the tour\n", options.last - options.first + 1,
             sum / double(options.last - options.first + 1));
}
