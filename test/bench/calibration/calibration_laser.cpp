// The laser's line in the image, and the plane of light that is calibrated from it.
#include <fmt/format.h>

#include <cmath>

#include "common/geometry.hpp"
#include "head/core/calibration/rig/laser_calibration.hpp"
#include "head/core/camera/head_model.hpp"
#include "test/bench/calibration/calibration_bench.hpp"
#include "test/support/stripe_renderer.hpp"

namespace priamos::bench {
namespace {

using namespace head;
using Eigen::Vector3d;

/// The third camera of the drawing [m, px], looking down at a fan of light on `board`.
support::StripeScene RandomScene(const support::Plane& board, Rng& rng) {
  HeadSetting setting;
  setting.tilt_rad = Radians(rng.Uniform(34, 38));
  support::StripeScene scene;
  const LensState lens{rng.Uniform(800, 900), {384 + rng.Normal(4), 288 + rng.Normal(4)}, -0.05, 0, 0.02};
  scene.camera = MakeCameraModel(lens, HeadGeometry().BaseFromCamera(setting, kThird, 0.02));
  scene.laser = {Vector3d(std::sin(0.35), 0.02, std::cos(0.35)).normalized(), Vector3d(0.46, 0, 0.60)};
  scene.board = board;
  scene.thickness_m = rng.Uniform(0.003, 0.005);
  scene.slope_per_px = rng.Uniform(-0.05, 0.05);
  return scene;
}

/// RMS error over all columns [px].
double LineError(double amplitude, double noise, int images, Rng rng, double& share, double& seconds) {
  StripeFinder finder;
  double squares = 0;
  int n = 0, columns = 0;
  seconds = 0;
  for (int i = 0; i < images; ++i) {
    support::StripeScene scene = RandomScene({Vector3d::UnitZ(), 0.0}, rng);
    scene.amplitude = amplitude;
    scene.noise = noise;
    const GreyImage image = support::Render(scene, rng);
    const double start = CpuSeconds();
    const auto points = finder.Find(image);
    seconds += CpuSeconds() - start;
    columns += image.width;
    for (const StripePoint& p : points) {
      squares += std::pow(p.at.y() - support::StripeRow(scene, p.at.x()), 2);
      ++n;
    }
  }
  seconds /= images;
  share = double(n) / columns;
  return std::sqrt(squares / n);
}

/// Largest distance of the calibrated plane from the true one, 1.2 to 2.1 m before the robot [m].
double PlaneError(const LaserPlane& dut, const support::Plane& truth) {
  double worst = 0;
  for (const double y : {-0.6, 0.0, 0.6}) {
    for (const double x : {1.2, 2.1})
      worst = std::max(worst, std::abs(dut.Plane().signedDistance(truth.projection(Vector3d(x, y, 0.2)))));
  }
  return worst;
}

/// Error of the plane [m], root mean square of `runs`, that was calibrated from the floor and a box top 0.15
/// m high, both placed to `board_sigma_m`.
double CalibratedPlane(double board_sigma_m, int runs, Rng rng) {
  double squares = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<StripeView> views;
    support::Plane truth;
    for (const double height : {0.0, 0.15}) {
      const auto scene = RandomScene({Vector3d::UnitZ(), Vector3d(0, 0, height)}, rng);
      truth = scene.laser;
      support::Plane told = scene.board;
      told.offset() += rng.Normal(board_sigma_m);
      views.push_back({scene.camera, told, StripeFinder().Find(support::Render(scene, rng))});
    }
    const auto dut = CalibrateLaserPlane(views);
    if (!dut) return 1e9;
    squares += std::pow(PlaneError(dut->plane, truth), 2);
  }
  return std::sqrt(squares / runs);
}

int PointsWithoutLaser(int images, Rng rng) {
  StripeFinder finder;
  int points = 0;
  for (int i = 0; i < images; ++i) {
    support::StripeScene scene = RandomScene({Vector3d::UnitZ(), 0.0}, rng);
    scene.amplitude = 0;
    scene.noise = rng.Uniform(1, 6);
    scene.blur_px = 0;
    points += static_cast<int>(finder.Find(support::Render(scene, rng)).size());
  }
  return points;
}

}  // namespace

void BenchLaser(const CalibrationOptions& options, Figures& figures) {
  double share = 0, seconds = 0;
  const int images = 50 / options.scale;
  const double error = LineError(120, 2, images, options.Stream("line"), share, seconds);
  figures.AtMost("laser line, contrast 120, noise 2: RMS of a column", error, 0.12, "px");
  figures.AtLeast("  columns found", share, 0.98, "");
  figures.AtMost("  time of an image, CPU", 1e3 * seconds, 0.3, "ms");
  figures.Note("laser line, contrast 50, noise 4: RMS of a column",
               LineError(50, 4, images, options.Stream("faint"), share, seconds), "px");
  figures.Note("  columns found", share, "");
  const int dark = 1000 / options.scale;
  figures.AtMost(fmt::format("{} images without laser, noise 1-6: points found", dark),
                 PointsWithoutLaser(dark, options.Stream("dark")), 0, "");
  const int runs = 20 / options.scale;
  figures.Note("laser plane from floor and box, places exact: RMS error",
               1e3 * CalibratedPlane(0, runs, options.Stream("plane")), "mm");
  figures.Note("  places to 0.5 mm", 1e3 * CalibratedPlane(0.0005, runs, options.Stream("placed")), "mm");
}

}  // namespace priamos::bench
