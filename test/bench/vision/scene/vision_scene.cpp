#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "head/core/doors/door_detection.hpp"
#include "head/core/look/usable_image.hpp"
#include "head/core/scene/scene_objects.hpp"
#include "test/bench/vision/scene/front_contrast.hpp"
#include "test/bench/vision/scene/scene_looks.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr double kFound_m = 0.1;     // between the middles, and of the width
constexpr double kSurface_m = 0.06;  // a front has a true surface so near, beyond 3 sigmas

/// What all looks showed.
struct SceneSeries {
  int wanted = 0, found = 0, boxes = 0, told = 0, phantoms = 0;
  int shown = 0, found_of_shown = 0;  ///< whose edges have contrast in both pictures
  std::vector<double> across_m, along_m, nees;

  void Judge(const SceneLook& look, const std::vector<head::SceneObject>& objects, bool verbose);

 private:
  void JudgeFront(const TrueFront& front, const std::vector<head::SceneObject>& objects);
};

/// Five places across the front at half of its height: each has a surface there, as the left camera sees it.
bool IsReal(const head::SceneObject& object, const Eyes& eyes) {
  const double sigma = std::sqrt(object.covariance.trace());
  for (int i = -2; i <= 2; ++i) {
    const Eigen::Vector2d at = object.base_from_front * Eigen::Vector2d(0, 0.4 * i / 2 * object.width_m);
    const Eigen::Vector3d point(at.x(), at.y(), (object.bottom_m + object.top_m) / 2);
    if (eyes.SurfaceBehind(point) > kSurface_m + 3 * sigma) return false;
  }
  return true;
}

void SceneSeries::JudgeFront(const TrueFront& front, const std::vector<head::SceneObject>& objects) {
  if (!front.is_to_be_found) return;
  ++wanted;
  const Eigen::Vector2d middle = front.middle();
  const double width = (front.left - front.right).norm();
  for (const head::SceneObject& object : objects) {
    if (object.kind == head::ObjectKind::kEdge) continue;
    const Eigen::Vector2d error = object.base_from_front.translation() - middle;
    if (error.norm() > kFound_m || std::abs(object.width_m - width) > kFound_m) continue;
    ++found;
    boxes += object.kind == head::ObjectKind::kBox;
    const Eigen::Vector2d in_front = object.base_from_front.rotation().transpose() * error;
    across_m.push_back(std::abs(in_front.x()));
    along_m.push_back(std::abs(in_front.y()));
    nees.push_back(error.dot(object.covariance.inverse() * error) / 2);
    return;
  }
}

void SceneSeries::Judge(const SceneLook& look, const std::vector<head::SceneObject>& objects, bool verbose) {
  for (const TrueFront& front : look.fronts) {
    const int before = found, asked = wanted;
    JudgeFront(front, objects);
    if (wanted > asked && ContrastOf(front, look).IsSeen()) ++shown, found_of_shown += found > before;
    if (verbose && wanted > asked)
      fmt::print("    {} {}: ({:.2f}, {:.2f}) {:.2f} m wide, {:.2f} high\n", front.name,
                 found > before ? "found" : "MISSED", front.middle().x(), front.middle().y(),
                 (front.left - front.right).norm(), front.top_m);
  }
  for (const head::SceneObject& object : objects) {
    if (object.kind == head::ObjectKind::kEdge) continue;
    ++told;
    const bool real = IsReal(object, look.eyes());
    phantoms += !real;
    if (verbose)
      fmt::print("    told {} {}: ({:.2f}, {:.2f}) {:.0f} deg, {:.2f} x {:.2f} m, {:.2f} to {:.2f} high\n",
                 object.kind == head::ObjectKind::kBox ? "box" : "face", real ? "real" : "PHANTOM",
                 object.base_from_front.x, object.base_from_front.y, Degrees(object.base_from_front.yaw),
                 object.width_m, object.depth_m, object.bottom_m, object.top_m);
  }
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

void Print(const SceneSeries& s, double seconds, int looks, Figures& figures) {
  fmt::print("  {} of {} fronts found, {} of them as boxes; {} faces told, {} phantoms; {:.1f} ms each\n",
             s.found, s.wanted, s.boxes, s.told, s.phantoms, 1e3 * seconds / looks);
  figures.AtLeast("  fronts found", static_cast<double>(s.found) / std::max(1, s.wanted), 0.95, "");
  figures.Note("  of those whose edges have contrast",
               static_cast<double>(s.found_of_shown) / std::max(1, s.shown), "");
  figures.AtMost("  phantoms of what is told", static_cast<double>(s.phantoms) / std::max(1, s.told), 0.02,
                 "");
  figures.AtMost("  error square to the front, 95 %", 1e3 * Quantile(s.across_m, 0.95), 30, "mm");
  figures.AtMost("  and along it", 1e3 * Quantile(s.along_m, 0.95), 30, "mm");
  figures.Note("  squared error over covariance, mean", Mean(s.nees), "");
  figures.Note("  median", Quantile(s.nees, 0.5), "");
}

}  // namespace

void BenchScene(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 40 : 400;
  fmt::print("what stands in made-up rooms, one stereo pair each: {} looks\n", n);
  ScenePhotographer photographer;
  const CalibratedHead head = CalibrateSpecimenWholly(1);
  head::EdgeOperator edges{head::DoorEdges()};
  std::array<head::EdgeImage, 3> seen;
  std::array<SceneSeries, 2> series;
  std::array<double, 2> seconds{};
  for (int i = 0; i < n; ++i) {
    const SceneLook look = photographer.Take(options.seed + i, head);
    for (int c = 0; c < 3; ++c) edges.Extract(head::Wrap(look.images[c]), seen[c]);
    const head::StereoViews views{head::MakeView(look.calibrated[0], seen[0]),
                                  head::MakeView(look.calibrated[1], seen[1])};
    const head::CameraView above = head::MakeView(look.calibrated[2], seen[2]);
    for (const bool third : {false, true}) {
      if (options.verbose) fmt::print("  look {}, {} cameras\n", options.seed + i, third ? 3 : 2);
      const double begin = CpuSeconds();
      auto matches = head::MatchBinocular(views[0], views[1], {});
      if (third)
        std::ranges::move(head::MatchTrinocular(views[0], views[1], above, {}), std::back_inserter(matches));
      const auto objects = head::ReconstructScene(views, matches, {}).objects;
      seconds[third] += CpuSeconds() - begin;
      series[third].Judge(look, objects, options.verbose);
    }
  }
  for (const bool third : {false, true}) {
    fmt::print(" {}\n", third ? "three cameras" : "two cameras");
    Print(series[third], seconds[third], n, figures);
  }
}

}  // namespace priamos::bench
