// Two processes that want to drive one base, again and again, with the real programs: do the wheels ever obey
// two, how soon do they stand, and who is left? Run it by scripts/in-private-network; a short form is a test.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "test/bench/bus/owner_trials.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bench {
namespace {

/// The wheels never obey two for longer.
constexpr double kBound_ms = 100;

double Milliseconds(Duration d) {
  return 1e3 * Seconds(d);
}

struct Column {
  std::vector<double> values_ms;
  void Add(Duration d) { values_ms.push_back(Milliseconds(d)); }
  std::string Text() {
    if (values_ms.empty()) return fmt::format("{:>8} {:>8}", "-", "-");
    std::sort(values_ms.begin(), values_ms.end());
    return fmt::format("{:>8.0f} {:>8.0f}", values_ms[values_ms.size() / 2], values_ms.back());
  }
};

/// Returns whether all trials of a kind were as they should be.
bool Study(OwnerRig& rig, const OwnerKind& kind, int trials) {
  int one_left = 0, right = 0, said = 0, alarms = 0, stood = 0, contested = 0, rolled_on = 0;
  double two_ms = 0;
  Column stands, settled;
  for (int i = 0; i < trials; ++i) {
    const OwnerTrial trial = kind.run(rig, i);
    one_left += trial.survivors == 1;
    right += trial.right_one;
    said += trial.said;
    alarms += trial.watch.alarms > 0;
    two_ms = std::max(two_ms, Milliseconds(trial.watch.two_obeyed));
    settled.Add(trial.settled);
    if (trial.watch.stood) stands.Add(*trial.watch.stood);
    stood += trial.watch.stood.has_value();
    contested += trial.watch.contested;
    rolled_on += trial.watch.contested && !trial.watch.stood;
    if (!trial.trouble.empty()) fmt::print(stderr, "{} {}: {}\n", kind.name, i, trial.trouble);
    rig.Wait(std::chrono::milliseconds(400));  // the board forgets the last one
  }
  fmt::print("{:<8} {:>6} {:>9} {:>9} {:>6} {:>7} {:>10.0f} {:>9} {:>6} {} {}   {}\n", kind.name, trials,
             one_left, right, said, alarms, two_ms, contested, stood, stands.Text(), settled.Text(),
             kind.what);
  std::fflush(stdout);
  constexpr int kMany = 10;  // one of two may yield before the board heard it
  const bool met = !kind.meets || trials < kMany || contested > 0;
  return one_left == trials && right == trials && said == trials && two_ms <= kBound_ms && rolled_on == 0 &&
         met;
}

int Run(const std::vector<std::string>& names, int trials, const OwnerRigOptions& options) {
  OwnerRig rig(options);
  fmt::print("{:<8} {:>6} {:>9} {:>9} {:>6} {:>7} {:>10} {:>9} {:>6} {:>17} {:>17}\n", "kind", "trials",
             "one left", "right one", "said", "alarms", "two obeyed", "contested", "stood", "stands after",
             "settled after");
  fmt::print("{:<8} {:>6} {:>9} {:>9} {:>6} {:>7} {:>10} {:>9} {:>6} {:>8} {:>8} {:>8} {:>8}\n", "", "", "",
             "", "", "", "worst ms", "", "", "median", "worst ms", "median", "worst ms");
  bool good = true;
  for (const OwnerKind& kind : OwnerKinds())
    if (names.empty() || std::find(names.begin(), names.end(), kind.name) != names.end())
      good = Study(rig, kind, trials) && good;
  fmt::print("{}\n", good ? "passed" : "not passed");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace priamos::bench

int main(int argc, char** argv) {
  int trials = 50;
  std::vector<std::string> kinds;
  std::string programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  CLI::App cli("Two owners of one base: who stays, and what the wheels do meanwhile", "bench_owners");
  cli.add_option("--trials", trials, "of each kind")->capture_default_str()->check(CLI::Range(1, 1000));
  cli.add_option("--kind", kinds, "only these: beside, at-once, healed, frozen, crashed");
  CLI11_PARSE(cli, argc, argv);
  try {
    const priamos::TemporaryFolder folder;
    return priamos::bench::Run(kinds, trials, {programs, PRIAMOS_SOURCE_DIR, folder.path().string(), 1});
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_owners: {}\n", error.what());
    return 2;
  }
}
