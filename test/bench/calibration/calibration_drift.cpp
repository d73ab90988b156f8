// The alarm that says at run time that the calibration no longer holds.
#include <fmt/format.h>

#include "common/geometry.hpp"
#include "head/core/drift/drift_monitor.hpp"
#include "test/bench/calibration/calibration_bench.hpp"
#include "test/support/drift_scene.hpp"

namespace priamos::bench {
namespace {

using namespace head;
using Eigen::Vector3d;

/// Share of windows of looks, all with the same errors of model and calibration, that raise the alarm.
double AlarmShare(const DriftConfig& config, const Vector3d& turn_rad, double nearest_m, int runs, Rng rng) {
  int alarms = 0;
  for (int run = 0; run < runs; ++run) {
    test::DriftScene scene({}, rng);
    scene.TurnRight(turn_rad);
    DriftMonitor monitor(config);
    for (int look = 0; look < config.looks; ++look) {
      const Pose2 pose{rng.Uniform(nearest_m, 4.0), rng.Uniform(-0.15, 0.15), rng.Uniform(-0.08, 0.08)};
      const auto drift =
          MeasureDrift(scene.model(), scene.Look(pose, rng), scene.camera(0), scene.camera(1), Lift(pose));
      if (drift) monitor.Add(*drift);
    }
    alarms += monitor.alarm().has_value();
  }
  return double(alarms) / runs;
}

}  // namespace

void BenchDrift(const CalibrationOptions& options, Figures& figures) {
  const int runs = 3000 / options.scale, few = 300 / options.scale;
  for (const double promised : {0.01, 0.001}) {
    DriftConfig config;
    config.false_alarm = promised;
    // Twice the standard deviation of the count is allowed above the promise.
    const double slack = 2 * std::sqrt(promised / runs);
    figures.AtMost(
        fmt::format("drift: false alarms of {} windows, {} promised", runs, promised),
        AlarmShare(config, Vector3d::Zero(), 2.4, runs, options.Stream(fmt::format("quiet {}", promised))),
        promised + slack, "");
  }
  const double pixel = 1.0 / 900;
  figures.AtLeast("drift: vergence 0.05 degrees, noticed within 3 looks",
                  AlarmShare({}, {0, Radians(0.05), 0}, 2.4, few, options.Stream("vergence")), 0.8, "");
  figures.AtLeast("drift: 1 px sideways, noticed",
                  AlarmShare({}, {0, pixel, 0}, 2.4, few, options.Stream("sideways")), 0.95, "");
  figures.AtLeast("drift: 1 px up, from 3 m on (lintel in view), noticed",
                  AlarmShare({}, {pixel, 0, 0}, 3.0, few, options.Stream("up")), 0.9, "");
  figures.Note("drift: 1 px up, from 2.4 m on, noticed",
               AlarmShare({}, {pixel, 0, 0}, 2.4, few, options.Stream("up near")), "");
}

}  // namespace priamos::bench
