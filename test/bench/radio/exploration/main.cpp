// Every world of two link ends with so many accidents, and the promises that they break. `bench_exploration
// --help`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "test/bus/radio/explorer/exploration.hpp"

namespace {

using namespace priamos::bus::radio;

/// Worlds of any kind with two to eight accidents, drawn from the seeds from `seed` on, for so long.
int ExploreAtRandom(std::uint64_t seed, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  std::size_t worlds = 0, findings = 0;
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds) {
    const std::uint64_t kind = seed + worlds;
    const ExploredWorld world{.datagrams = kind % 2 == 1,
                              .packet_overhead = priamos::Duration(kind % 4 == 3 ? 5000 : 0),
                              .rekey = kind % 3 == 1};
    const auto mishaps = RandomMishaps(world, 2 + kind % 7, kind);
    for (const std::string& broken : ExploredRun(world, mishaps).Run()) {
      ++findings;
      fmt::print("seed {}, {}{}{}: {}: {}\n", kind, world.datagrams ? "datagrams" : "serial",
                 kind % 4 == 3 ? " of a packet radio" : "", world.rekey ? ", rekey" : "", TextOf(mishaps),
                 broken);
    }
    ++worlds;
  }
  fmt::print("{} worlds from seed {} on, {} findings\n", worlds, seed, findings);
  return findings == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App cli(
      "Searches all worlds with up to so many accidents for a broken promise of bus/radio/README.md.");
  int depth = 2;
  std::size_t parts = 64, first = 0, last = 63;
  ExploredWorld world;
  cli.add_option("--depth", depth, "accidents per world; 2: about a million worlds")->capture_default_str();
  cli.add_flag("--datagrams", world.datagrams, "a network that reorders, not a serial line");
  cli.add_flag("--rekey", world.rekey, "the ends change their key meanwhile");
  cli.add_option("--parts", parts, "the work in so many parts, by the place of the first accident")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  cli.add_option("--first", first, "the first part to run")->capture_default_str();
  cli.add_option("--last", last, "the last one")->capture_default_str();
  std::uint64_t seed = 1;
  double random_s = 0;
  cli.add_option("--random", random_s,
                 "instead worlds with two to eight accidents at random, for so many seconds");
  cli.add_option("--seed", seed, "the first of these worlds")->capture_default_str();
  CLI11_PARSE(cli, argc, argv);
  if (random_s > 0) return ExploreAtRandom(seed, random_s);
  std::size_t runs = 0, findings = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t part = first; part <= last && part < parts; ++part) {
    const Explored explored = Explore(world, depth, part, parts);
    runs += explored.runs;
    findings += explored.findings.size();
    for (const std::string& finding : explored.findings) fmt::print("{}\n", finding);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    fmt::print("part {} of {}: {} worlds, {} findings, {:.0f} s\n", part, parts, runs, findings,
               took.count());
    std::fflush(stdout);
  }
  return findings == 0 ? 0 : 1;
}
