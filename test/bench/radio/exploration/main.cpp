// Every world of two link ends with so many accidents, and the promises that they break. `bench_exploration
// --help`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "test/bus/radio/explorer/exploration.hpp"

int main(int argc, char** argv) {
  using namespace priamos::bus::radio;
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
  CLI11_PARSE(cli, argc, argv);
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
