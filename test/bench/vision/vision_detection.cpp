#include <fmt/format.h>

#include "head/core/doors/door_detection.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/bench/vision/door_looks.hpp"
#include "test/bench/vision/timed_doors.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

struct Count {
  int looks = 0, with_door = 0, found = 0, false_ones = 0, off = 0;
};

void Add(const LandmarkLook& look, const std::vector<head::DetectedDoor>& doors, Count& count) {
  const Eigen::Vector2d front = look.truth * Eigen::Vector2d(-0.085, 0);
  ++count.looks;
  count.with_door += look.is_there;
  bool found = false;
  for (const head::DetectedDoor& door : doors) {
    const double error = (door.base_from_door.translation() - front).norm();
    const bool is_it = look.is_there && error < 0.25;
    found = found || is_it;
    count.false_ones += !is_it;
    count.off += is_it && error > 0.03;
  }
  count.found += found;
}

}  // namespace

void BenchDetection(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 10 : 100;
  fmt::print(
      "doors without a map, 2.4 m away: {} open, {} with the leaf anywhere from closed to 90 degrees, {} "
      "walls\n",
      n, n, n);
  DoorPhotographer photographer;
  head::EdgeOperator edge_operator(head::DoorEdges());
  Count count;
  double seconds = 0;
  for (const Trouble trouble : {Trouble::kNone, Trouble::kLeafMoved, Trouble::kDoorAbsent}) {
    for (int i = 0; i < n; ++i) {
      const std::uint64_t seed = options.seed + i;
      const LandmarkLook look = photographer.Take(seed, trouble, CalibrateSpecimen(seed % 7 + 1));
      const auto doors = DetectTimed(look.images, look.calibrated, edge_operator, seconds);
      Add(look, doors, count);
    }
  }
  figures.AtLeast("  found", 100.0 * count.found / count.with_door, 98, "%");
  figures.AtMost("  false ones, of all looks", 100.0 * count.false_ones / count.looks, 1, "%");
  figures.AtMost("  more than 3 cm beside the truth, of those found",
                 100.0 * count.off / std::max(1, count.found), 2, "%");
  figures.Note("  time per stereo pair, edges included", 1000 * seconds / count.looks, "ms");
}

}  // namespace priamos::bench
