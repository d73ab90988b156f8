// Driving by hand with real processes, the real spacenavd and a radio on pseudo terminals: latency from the
// stick to the wheels, stops when something ends, e-stops through a full radio, crashes and hangs of every
// process.
//   scripts/in-private-network build/bin/bench_driving [--latency N] [--stops N] [--estop N]
//   [--estop-saturated N]
//     [--crashes N] [--stalls N] [--burden SECONDS]
// Needs a quiet machine: prints the load before and after. Exit 1 if a promise is broken.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "test/bench/driving/driving_studies.hpp"

namespace {

std::string Load() {
  std::string load;
  std::getline(std::ifstream("/proc/loadavg"), load);
  return load;
}

std::string RunFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "priamos-driving-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder " + name);
  return name;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace priamos::bench;
  RigOptions options;
  options.source_folder = PRIAMOS_SOURCE_DIR;
  options.program_folder = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  int latency = 0, stops = 0, estop = 0, saturated = 0, crashes = 0, stalls = 0, burden = 0;
  std::string estop_only, crash_only;
  CLI::App app("Driving by hand: what is promised, measured");
  app.add_option("--latency", latency, "samples from the stick to the wheels, from rest and on the way");
  app.add_option("--stops", stops,
                 "stops of each kind at full speed: released, unplugged, killed, radio cut");
  app.add_option("--estop", estop, "e-stops by mouse, keyboard and command each");
  app.add_option("--estop-saturated", saturated,
                 "e-stops through a radio that has more to carry than it can");
  app.add_option("--estop-only", estop_only, "mouse, keyboard, priamos or bus; without it all of them");
  app.add_option("--crashes", crashes, "kills and hangs of every process while it drives");
  app.add_option("--crash-only", crash_only, "a part of the name of a process; without it all of them");
  app.add_option("--stalls", stalls, "short stops of every process, after which it goes on with what it had");
  app.add_option("--burden", burden, "seconds beside busy loops, in which nothing may be taken for hung");
  app.add_option("--seed", options.seed, "of moments and of the simulated hardware")->capture_default_str();
  app.add_option("--programs", options.program_folder, "where priamos-* are")->capture_default_str();
  app.add_option("--source", options.source_folder, "the tree with the configuration")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    options.run_folder = RunFolder();
    fmt::print("load {}; consoles in {}\n", Load(), options.run_folder);
    int broken = 0;
    if (latency > 0) broken += StudyLatency(options, latency);
    if (stops > 0) broken += StudyStops(options, stops);
    if (estop > 0 || saturated > 0) broken += StudyEstop(options, estop, saturated, estop_only);
    if (crashes > 0) broken += StudyCrashes(options, crashes, crash_only);
    if (burden > 0) broken += StudyBurden(options, burden);
    if (stalls > 0) broken += StudyStalls(options, stalls);
    fmt::print("load {}; {}\n", Load(),
               broken == 0 ? "every promise held" : fmt::format("{} BROKEN", broken));
    return broken == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "bench_driving: " << error.what() << "\n";
    return 2;
  }
}
