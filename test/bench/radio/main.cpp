// Every figure that the radio link must hold, measured. `bench_radio --help`.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "figures.hpp"

int main(int argc, char** argv) {
  using namespace priamos::bench;
  CLI::App cli("Figures of the radio link, in simulated time; with --real-time over ptys.");
  Effort effort;
  bool real_time = false, packets = false;
  RealTimeOptions options;
  cli.add_flag("--long", effort.long_run, "10^7 damaged frames, and more runs: about ten minutes");
  cli.add_flag("--packets", packets, "packet radios alone: about half a minute");
  cli.add_option("--seed", effort.seed, "of several robots' messages")->capture_default_str();
  cli.add_flag("--real-time", real_time,
               "two priamos-radio on an emulated line; run it with scripts/in-private-network");
  cli.add_option("--seconds", options.seconds, "length of the real-time run")->capture_default_str();
  cli.add_option("--bit-error-rate", options.bit_error_rate, "of the line of the real-time run")
      ->capture_default_str();
  CLI11_PARSE(cli, argc, argv);
  Figures figures;
  try {
    if (real_time) {
      RealTime(figures, std::filesystem::read_symlink("/proc/self/exe").parent_path().string(), options);
    } else if (packets) {
      Packets(figures, effort);
    } else {
      SideBySide(figures);
      Differences(figures);
      SimulatedLink(figures, effort);
      Commands(figures, effort);
      Stops(figures, effort);
      Hostile(figures, effort);
      SharedChannel(figures, effort);
      Packets(figures, effort);
    }
  } catch (const std::exception& error) {
    std::cerr << "bench_radio: " << error.what() << "\n";
    return 2;
  }
  return figures.all_met() ? 0 : 1;
}
