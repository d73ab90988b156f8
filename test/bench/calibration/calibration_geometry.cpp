#include <fmt/format.h>

#include "head/core/calibration/resection/dlt.hpp"
#include "head/core/calibration/resection/triangulation.hpp"
#include "head/core/calibration/targets/camera_calibration.hpp"
#include "test/bench/calibration/calibration_bench.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::bench {
namespace {

using namespace head;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Left (-1) or right (+1) of two cameras 0.3 m apart before the object.
CameraModel StereoCamera(double side, double distance_m) {
  support::CameraView view;
  view.distance_m = distance_m;
  const CameraModel middle = support::MakeCamera(view);
  CameraModel camera = middle;
  // Seen from the cameras the object's y axis points to the right.
  camera.image_from_base.col(3) -= middle.image_from_base.col(1) * 0.15 * side;
  return camera;
}

}  // namespace

void BenchDlt(const CalibrationOptions& options, Figures& figures) {
  Rng rng = options.Stream("dlt");
  int failures = 0;
  const int problems = 10000 / options.scale;
  for (int i = 0; i < problems; ++i) {
    const CameraModel camera = support::MakeCamera(support::RandomView(rng));
    const double noise = rng.Uniform(0.1, 1);
    std::vector<PointPair> pairs(6 + rng.Below(11));
    for (PointPair& p : pairs) {
      p.point_m = {rng.Uniform(-0.25, 0.25), rng.Uniform(-0.3, 0.3), rng.Uniform(-0.3, 0.3)};
      p.image_px = camera.Project(p.point_m) + Vector2d(rng.Normal(noise), rng.Normal(noise));
    }
    const auto solved = SolveDlt(pairs);
    failures += !solved || MeanImageError(*solved, pairs) > 3 * noise;
  }
  figures.AtMost(fmt::format("DLT: failures in {} random problems, 6-16 points, 0.1-1 px", problems),
                 failures, 0, "");
  std::vector<PointPair> pairs;
  const CameraModel camera = support::MakeCamera({});
  for (const ReferenceDisc& disc : support::ShippedReferenceObject().discs) {
    pairs.push_back(
        {disc.centre_m, camera.Project(disc.centre_m) + Vector2d(rng.Normal(0.1), rng.Normal(0.1))});
  }
  const double start = CpuSeconds();
  for (int i = 0; i < 2000; ++i) {
    if (!SolveDlt(pairs)) ++failures;
  }
  figures.AtMost("DLT: 16 points", 1e6 * (CpuSeconds() - start) / 2000, 50, "us");
}

void BenchDepth(const CalibrationOptions& options, Figures& figures) {
  const ReferenceObject object = support::ShippedReferenceObject();
  const CameraModel truth[] = {StereoCamera(-1, 1.5), StereoCamera(1, 1.5)};
  Rng rng = options.Stream("depth");
  double sum = 0, squares = 0;
  int n = 0;
  for (int i = 0; i < 60 / std::min(options.scale, 3); ++i) {
    CameraModel measured[2];
    for (int c = 0; c < 2; ++c) {
      support::DiscRenderer scene(768, 576, 20, 1);
      for (const ReferenceDisc& disc : object.discs) scene.AddDisc(truth[c], disc, 200);
      const DiscLabeller labeller(object);
      const auto calibrated =
          CalibrateCamera(scene.Expose({0.7, 2}, rng), object, labeller, Eigen::Isometry3d::Identity());
      if (!calibrated) return figures.AtMost("depth at 2.4 m: not calibrated", 1, 0, "");
      measured[c] = calibrated->model;
    }
    for (double y = -0.6; y <= 0.6; y += 0.3) {
      for (double z = -0.4; z <= 0.4; z += 0.2) {
        const Vector3d point(0.12 - 0.9, y, z);  // 2.4 m before the cameras
        const Ray rays[] = {{&measured[0], truth[0].Project(point)}, {&measured[1], truth[1].Project(point)}};
        const auto found = Triangulate(rays);
        if (!found) return figures.AtMost("depth at 2.4 m: no intersection", 1, 0, "");
        const double error = found->x() - point.x();
        sum += error;
        squares += error * error;
        ++n;
      }
    }
  }
  figures.AtMost("depth bias at 2.4 m from 16 discs at 1.5 m (baseline 0.3 m)", 1e3 * std::abs(sum / n), 1,
                 "mm");
  figures.Note("  RMS of the depth error of single calibrations", 1e3 * std::sqrt(squares / n), "mm");
}

}  // namespace priamos::bench
