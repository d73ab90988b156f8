#include <fmt/format.h>

#include <algorithm>

#include "test/bench/calibration/calibration_bench.hpp"
#include "test/support/head_sweep.hpp"

namespace priamos::bench {

using namespace head;

void BenchTable(const CalibrationOptions& options, Figures& figures) {
  constexpr double kPromise_px = 0.1;
  double nodes = 0, between = 0, worst_ratio = 0, best_spoilt = 1e9;
  const int heads = options.scale > 1 ? 1 : 5;
  Rng seeds = options.Stream("table");
  for (int i = 0; i < heads; ++i) {
    const CalibrationPlan plan;
    const std::uint64_t seed = seeds.Below(1'000'000);
    PositionerConfig direct;
    direct.approach_rad = 0;
    direct.approach_steps = 0;
    for (const PositionerConfig& motors : {PositionerConfig(), direct}) {
      support::SimulatedHead simulated(seed);
      const auto calibrated = SolveHead(support::Sweep(simulated, plan.Settings(), motors, seed));
      if (!calibrated) return figures.AtMost("table over zoom and focus: not calibrated", 1, 0, "");
      const auto error = support::MeasureTable(calibrated->model, simulated, plan);
      if (motors.approach_steps == 0) {
        best_spoilt = std::min(best_spoilt, error.between_px);
      } else {
        nodes = std::max(nodes, error.at_nodes_px);
        between = std::max(between, error.between_px);
        worst_ratio = std::max(worst_ratio, error.between_px / error.at_nodes_px);
      }
    }
  }
  figures.Note(fmt::format("table, {} heads: error at the nodes, worst head", heads), nodes, "px");
  figures.AtMost(fmt::format("table, {} heads: error between the nodes, worst head", heads), between,
                 kPromise_px, "px");
  figures.AtMost("table: error between the nodes over that at the nodes, worst head", worst_ratio, 1.5, "");
  figures.AtLeast("table without the one-sided approach: error, best head", best_spoilt, kPromise_px, "px");
}

}  // namespace priamos::bench
