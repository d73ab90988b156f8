#pragma once

#include "head/core/calibration/rig/calibration_plan.hpp"
#include "head/core/motion/head_positioner.hpp"
#include "test/support/simulated_head.hpp"

namespace priamos::support {

/// What the head sees of the shipped object, 1.8 m before it, when its own positioner drives the simulated
/// motors through `settings`; centroids with the noise of the detector.
std::vector<head::HeadView> Sweep(SimulatedHead& simulated, const std::vector<head::HeadSetting>& settings,
                                  const head::PositionerConfig& motors, std::uint64_t seed);

/// Root mean square image error [px] of a calibrated camera at one setting, over the whole image, for points
/// 2 m before the camera; infinity where the calibration does not know the setting.
double ImageError(const head::HeadModel& dut, const SimulatedHead& truth, const head::HeadSetting& setting,
                  int camera);

/// ImageError of left and right camera at the nodes of a plan, and at settings half way between them.
struct TableError {
  double at_nodes_px = 0, between_px = 0;
};
TableError MeasureTable(const head::HeadModel& dut, const SimulatedHead& truth,
                        const head::CalibrationPlan& plan);

}  // namespace priamos::support
