#include "test/support/head_sweep.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "common/geometry.hpp"
#include "test/support/calibration_scene.hpp"

namespace priamos::support {

namespace {

using head::HeadSetting;

constexpr double kDetector_px = 0.01;

/// The motors obey at once.
void Approach(SimulatedHead& simulated, const HeadSetting& goal, const head::PositionerConfig& config) {
  head::HeadPositioner positioner(config);
  Time now{};
  positioner.MoveTo(goal, now);
  while (!positioner.settled() && !positioner.failed()) {
    now += FromSeconds(0.05);
    const head::HeadReport report{now, simulated.counters(), false};
    if (const auto command = positioner.Step(&report, now)) simulated.MoveTo(*command);
  }
}

std::vector<int> Halfway(const std::vector<int>& steps) {
  std::vector<int> halfway;
  for (std::size_t i = 1; i < steps.size(); ++i) halfway.push_back((steps[i - 1] + steps[i]) / 2);
  return halfway;
}

double MeanError(const head::HeadModel& dut, const SimulatedHead& truth, const std::vector<int>& zooms,
                 const std::vector<int>& focuses) {
  double squares = 0;
  int n = 0;
  for (const int zoom : zooms) {
    for (const int focus : focuses) {
      const HeadSetting setting{0.03, 0, {-0.02, 0.02}, {zoom, zoom}, {focus, focus}};
      for (const int camera : {head::kLeft, head::kRight}) {
        squares += std::pow(ImageError(dut, truth, setting, camera), 2);
        ++n;
      }
    }
  }
  return std::sqrt(squares / n);
}

}  // namespace

std::vector<head::HeadView> Sweep(SimulatedHead& simulated, const std::vector<HeadSetting>& settings,
                                  const head::PositionerConfig& motors, std::uint64_t seed) {
  Rng rng(seed);
  const ReferenceObject in_base = ShippedReferenceObject().Moved(ObjectBeforeHead(1.8));
  std::vector<head::HeadView> views;
  int exposure = 0;
  for (const HeadSetting& setting : settings) {
    Approach(simulated, setting, motors);
    for (head::HeadView& view : Observe(simulated, in_base, exposure, kDetector_px, rng))
      views.push_back(std::move(view));
    ++exposure;
  }
  return views;
}

double ImageError(const head::HeadModel& dut, const SimulatedHead& truth, const HeadSetting& setting,
                  int camera) {
  const auto model = dut.CameraAt(setting, camera);
  if (!model) return std::numeric_limits<double>::infinity();
  const head::CameraModel real = truth.AfterApproach(setting, camera);
  const Eigen::Matrix3d inverse = real.image_from_base.leftCols<3>().inverse();
  const Eigen::Vector3d eye = -inverse * real.image_from_base.col(3);
  double squares = 0;
  int n = 0;
  for (double u = 34; u < 768; u += 100) {
    for (double v = 38; v < 576; v += 100) {
      const Eigen::Vector3d point = eye + 2 * (inverse * Eigen::Vector2d(u, v).homogeneous()).normalized();
      squares += (model->Distort(model->Project(point)) - real.Distort(real.Project(point))).squaredNorm();
      ++n;
    }
  }
  return std::sqrt(squares / n);
}

TableError MeasureTable(const head::HeadModel& dut, const SimulatedHead& truth,
                        const head::CalibrationPlan& plan) {
  const std::vector<int> zooms = plan.zoom.Steps(), focuses = plan.focus.Steps();
  return {MeanError(dut, truth, zooms, focuses), MeanError(dut, truth, Halfway(zooms), Halfway(focuses))};
}

}  // namespace priamos::support
