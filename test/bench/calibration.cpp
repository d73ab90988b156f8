// How well the head calibrates itself: every figure that is promised, measured on exactly rendered images.
//   calibration [--quick]
// Prints one line per figure with its bound; exit 1 if one is missed. --quick takes a tenth of the samples.
#include <fmt/format.h>

#include <ctime>
#include <functional>
#include <string_view>

#include "common/geometry.hpp"
#include "head/core/calibration/calibration_quality.hpp"
#include "head/core/calibration/disc_detection.hpp"
#include "head/core/calibration/dlt.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"
#include "test/support/head_sweep.hpp"

namespace priamos {
namespace {

using namespace head;
using Eigen::Vector2d;
using Eigen::Vector3d;

int missed = 0;

void Report(std::string_view what, double value, double bound, std::string_view unit) {
  const bool held = value <= bound;
  missed += !held;
  fmt::print("{:66} {:10.4f} {:3} <= {:<8g} {}\n", what, value, unit, bound, held ? "" : "MISSED");
}

/// CPU time of this thread [s]: other work on the machine does not count.
double CpuSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

// --- one disc ---------------------------------------------------------------------------------------------

/// RMS distance between the disc's true centre and the detected one, eccentricity corrected with the true
/// camera; -1 if a disc was not found.
double CentreError(int samples, double radius_px, double tilt_rad) {
  Rng rng(1);
  double squares = 0;
  for (int i = 0; i < samples; ++i) {
    support::CameraView view;
    view.focal_px = 1200;
    view.distance_m = 1.5;
    view.azimuth_rad = tilt_rad;
    view.roll_rad = rng.Uniform(0, kPi);
    view.target_m = {0, 0, 0};
    view.centre_px = {48 + rng.Uniform(-0.5, 0.5), 48 + rng.Uniform(-0.5, 0.5)};
    const CameraModel camera = support::MakeCamera(view);
    const ReferenceDisc disc{{0, 0, 0}, {1, 0, 0}, radius_px * view.distance_m / view.focal_px};
    support::DiscRenderer scene(96, 96, 20, 3);
    scene.AddDisc(camera, disc, 200);
    const auto found = DetectDiscs(scene.Expose({0.7, 2}, rng));
    if (found.size() != 1) return -1;
    const Vector2d centre = found[0].ellipse.centre_px - CentroidBias(camera, disc);
    squares += (centre - camera.Project(disc.centre_m)).squaredNorm();
  }
  return std::sqrt(squares / samples);
}

// --- correspondence ---------------------------------------------------------------------------------------

struct LabelCounts {
  int views = 0, complete = 0, refused = 0, wrong_labels = 0;
  double slowest_s = 0, seconds = 0;
};

void Count(const Outcome<Labelling>& found, int visible, const std::function<bool(const Label&)>& right,
           LabelCounts& counts) {
  ++counts.views;
  if (!found) {
    ++counts.refused;
    return;
  }
  int wrong = 0;
  for (const Label& label : found->labels) wrong += !right(label);
  counts.wrong_labels += wrong;
  counts.complete += wrong == 0 && static_cast<int>(found->labels.size()) == visible;
}

/// Whole images: detection and correspondence, random gain, clutter, up to 6 discs hidden.
LabelCounts LabelImages(int views, const ReferenceObject& object, const DiscLabeller& labeller) {
  LabelCounts counts;
  Rng rng(2);
  for (int i = 0; i < views; ++i) {
    const CameraModel camera = support::MakeCamera(support::RandomView(rng));
    const auto sightings = support::Sight(object, camera, static_cast<int>(rng.Below(7)), 0, rng);
    const GreyImage image = support::RenderSightings(object, camera, sightings.truth, rng);
    const double start = CpuSeconds();
    const auto detections = DetectDiscs(image);
    const auto found = labeller.Label(detections);
    const double seconds = CpuSeconds() - start;
    counts.seconds += seconds;
    counts.slowest_s = std::max(counts.slowest_s, seconds);
    Count(
        found, sightings.visible,
        [&](const Label& label) {
          const auto centroid = ProjectDiscCentroid(camera, object.discs[label.disc]);
          return centroid && (detections[label.detection].ellipse.centre_px - *centroid).norm() < 1;
        },
        counts);
  }
  return counts;
}

/// Detections made up with a detector's noise: many more views, more clutter.
LabelCounts LabelSightings(int views, const ReferenceObject& object, const DiscLabeller& labeller) {
  LabelCounts counts;
  Rng rng(3);
  for (int i = 0; i < views; ++i) {
    const CameraModel camera = support::MakeCamera(support::RandomView(rng));
    const auto s =
        support::Sight(object, camera, static_cast<int>(rng.Below(7)), static_cast<int>(rng.Below(15)), rng);
    Count(
        labeller.Label(s.detections), s.visible,
        [&](const Label& label) { return s.truth[label.detection] == label.disc; }, counts);
  }
  return counts;
}

void Correspondence(int scale) {
  const ReferenceObject object = support::ShippedReferenceObject();
  const DiscLabeller labeller(object);
  const LabelCounts images = LabelImages(1000 / scale, object, labeller);
  Report(fmt::format("{} images: views not labelled completely", images.views),
         images.views - images.complete, images.views / 1000.0, "");
  Report(fmt::format("{} images: wrong labels", images.views), images.wrong_labels, 0, "");
  Report("whole frame, detection and correspondence, mean CPU time", 1e3 * images.seconds / images.views, 2,
         "ms");
  const LabelCounts views = LabelSightings(10000 / scale, object, labeller);
  Report(fmt::format("{} sightings with clutter: not labelled completely", views.views),
         views.views - views.complete, views.views / 1000.0, "");
  Report(fmt::format("{} sightings with clutter: wrong labels", views.views), views.wrong_labels, 0, "");
}

// --- DLT --------------------------------------------------------------------------------------------------

void Dlt(int scale) {
  Rng rng(4);
  int failures = 0;
  const int problems = 10000 / scale;
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
  Report(fmt::format("DLT: failures in {} random problems, 6-16 points, 0.1-1 px", problems), failures, 0,
         "");
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
  Report("DLT: 16 points", 1e6 * (CpuSeconds() - start) / 2000, 50, "us");
}

// --- depth
// --------------------------------------------------------------------------------------------------

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

void DepthBias(int scale) {
  const ReferenceObject object = support::ShippedReferenceObject();
  const CameraModel truth[] = {StereoCamera(-1, 1.5), StereoCamera(1, 1.5)};
  Rng rng(5);
  double sum = 0, squares = 0;
  int n = 0;
  for (int i = 0; i < 60 / std::min(scale, 3); ++i) {
    CameraModel measured[2];
    for (int c = 0; c < 2; ++c) {
      support::DiscRenderer scene(768, 576, 20, 1);
      for (const ReferenceDisc& disc : object.discs) scene.AddDisc(truth[c], disc, 200);
      const DiscLabeller labeller(object);
      const auto calibrated =
          CalibrateCamera(scene.Expose({0.7, 2}, rng), object, labeller, Eigen::Isometry3d::Identity());
      if (!calibrated) return Report("depth at 2.4 m: not calibrated", 1, 0, "");
      measured[c] = calibrated->model;
    }
    for (double y = -0.6; y <= 0.6; y += 0.3) {
      for (double z = -0.4; z <= 0.4; z += 0.2) {
        const Vector3d point(0.12 - 0.9, y, z);  // 2.4 m before the cameras
        const Ray rays[] = {{&measured[0], truth[0].Project(point)}, {&measured[1], truth[1].Project(point)}};
        const auto found = Triangulate(rays);
        if (!found) return Report("depth at 2.4 m: no intersection", 1, 0, "");
        const double error = found->x() - point.x();
        sum += error;
        squares += error * error;
        ++n;
      }
    }
  }
  Report("depth bias at 2.4 m from 16 discs at 1.5 m (baseline 0.3 m)", 1e3 * std::abs(sum / n), 1, "mm");
  fmt::print("{:66} {:10.4f} mm\n", "  RMS of the depth error of single calibrations",
             1e3 * std::sqrt(squares / n));
}

// --- table over zoom and focus
// ------------------------------------------------------------------------------

void Table(int scale) {
  double nodes = 0, between = 0, spoilt = 0;
  const int heads = scale > 1 ? 1 : 5;
  for (int i = 0; i < heads; ++i) {
    const CalibrationPlan plan;
    PositionerConfig direct;
    direct.approach_rad = 0, direct.approach_steps = 0;
    for (const PositionerConfig& motors : {PositionerConfig(), direct}) {
      support::SimulatedHead simulated(20 + i);
      const auto calibrated = SolveHead(support::Sweep(simulated, plan.Settings(), motors, 20 + i));
      if (!calibrated) return Report("table over zoom and focus: not calibrated", 1, 0, "");
      const auto error = support::MeasureTable(calibrated->model, simulated, plan);
      if (motors.approach_steps == 0) {
        spoilt = std::max(spoilt, error.between_px);
      } else {
        nodes = std::max(nodes, error.at_nodes_px), between = std::max(between, error.between_px);
      }
    }
  }
  Report(fmt::format("table, {} heads: error between the nodes, worst head", heads), between, 0.1, "px");
  Report("table: error between the nodes over that at the nodes", between / nodes, 1.5, "");
  fmt::print("{:66} {:10.4f} px\n", "  the same without the one-sided approach", spoilt);
}

}  // namespace
}  // namespace priamos

int main(int argc, char** argv) {
  using namespace priamos;
  const int scale = argc > 1 && std::string_view(argv[1]) == "--quick" ? 10 : 1;
  Report("disc centre, front view, r = 8 px, noise 2: RMS", CentreError(2000 / scale, 8, 0), 0.0075, "px");
  Report("disc centre, 45 degrees, r = 16 px, noise 2: RMS", CentreError(1000 / scale, 16, Radians(45)),
         0.015, "px");
  Correspondence(scale);
  Dlt(scale);
  DepthBias(scale);
  Table(scale);
  fmt::print("{}\n", missed ? fmt::format("{} figures missed", missed) : "all figures held");
  return missed ? 1 : 0;
}
