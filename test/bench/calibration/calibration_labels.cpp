#include <fmt/format.h>

#include <functional>

#include "head/core/calibration/correspondence/correspondence.hpp"
#include "head/core/calibration/discs/disc_detection.hpp"
#include "test/bench/calibration/calibration_bench.hpp"
#include "test/support/calibration_scene.hpp"

namespace priamos::bench {
namespace {

using namespace head;

struct LabelCounts {
  int views = 0, complete = 0, refused = 0, wrong_labels = 0;
  double slowest_s = 0, seconds = 0;
};

void Count(const Outcome<Labelling>& found, int visible, const std::function<bool(const DiscLabel&)>& right,
           LabelCounts& counts) {
  ++counts.views;
  if (!found) {
    ++counts.refused;
    return;
  }
  int wrong = 0;
  for (const DiscLabel& label : found->labels) wrong += !right(label);
  counts.wrong_labels += wrong;
  counts.complete += wrong == 0 && static_cast<int>(found->labels.size()) == visible;
}

/// Whole images: detection and correspondence, random gain, clutter, up to 6 discs hidden.
LabelCounts LabelImages(int views, const ReferenceObject& object, const DiscLabeller& labeller, Rng rng) {
  LabelCounts counts;
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
        [&](const DiscLabel& label) {
          const auto centroid = ProjectDiscCentroid(camera, object.discs[label.disc]);
          return centroid && (detections[label.detection].ellipse.centre_px - *centroid).norm() < 1;
        },
        counts);
  }
  return counts;
}

/// Detections made up with a detector's noise: many more views, more clutter.
LabelCounts LabelSightings(int views, const ReferenceObject& object, const DiscLabeller& labeller, Rng rng) {
  LabelCounts counts;
  for (int i = 0; i < views; ++i) {
    const CameraModel camera = support::MakeCamera(support::RandomView(rng));
    const auto s =
        support::Sight(object, camera, static_cast<int>(rng.Below(7)), static_cast<int>(rng.Below(15)), rng);
    Count(
        labeller.Label(s.detections), s.visible,
        [&](const DiscLabel& label) { return s.truth[label.detection] == label.disc; }, counts);
  }
  return counts;
}

}  // namespace

void BenchLabels(const CalibrationOptions& options, Figures& figures) {
  const ReferenceObject object = support::ShippedReferenceObject();
  const DiscLabeller labeller(object);
  const LabelCounts images =
      LabelImages(1000 / options.scale, object, labeller, options.Stream("label images"));
  figures.AtMost(fmt::format("{} images: views not labelled completely", images.views),
                 images.views - images.complete, images.views / 1000.0, "");
  figures.AtMost(fmt::format("{} images: wrong labels", images.views), images.wrong_labels, 0, "");
  figures.AtMost("whole frame, detection and correspondence, mean CPU time",
                 1e3 * images.seconds / images.views, 2, "ms");
  figures.Note("  the slowest of them", 1e3 * images.slowest_s, "ms");
  const LabelCounts views =
      LabelSightings(10000 / options.scale, object, labeller, options.Stream("label sightings"));
  figures.AtMost(fmt::format("{} sightings with clutter: not labelled completely", views.views),
                 views.views - views.complete, views.views / 1000.0, "");
  figures.AtMost(fmt::format("{} sightings with clutter: wrong labels", views.views), views.wrong_labels, 0,
                 "");
}

}  // namespace priamos::bench
