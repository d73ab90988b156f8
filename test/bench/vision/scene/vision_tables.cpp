#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "head/core/doors/door_detection.hpp"
#include "head/core/look/usable_image.hpp"
#include "head/core/scene/hanging_tracks.hpp"
#include "head/core/scene/scene_objects.hpp"
#include "head/core/scene/scene_tracks.hpp"
#include "test/bench/vision/scene/table_looks.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

constexpr double kNear_m = 0.08;

/// What approaches of one kind showed.
struct TableSeries {
  int approaches = 0, found = 0, boxes = 0, looks = 0, seen = 0;
};

/// What hangs, over all looks.
struct HangingSeries {
  int looks = 0, told = 0, phantoms = 0, believed = 0, believed_phantoms = 0;
  double seconds = 0;
};

head::SceneObject Placed(const head::SceneTrack& track) {
  head::SceneObject object = track.object;
  object.base_from_front = track.place.map_from_thing;
  return object;
}

void PrintObject(const char* what, const head::SceneObject& o, bool real, bool of_table) {
  fmt::print("    {} {}{}: ({:.2f}, {:.2f}) {:.0f} deg, {:.2f} x {:.2f} m at {:.2f}\n", what,
             real ? "real" : "PHANTOM", of_table ? ", table" : "", o.base_from_front.x, o.base_from_front.y,
             Degrees(o.base_from_front.yaw), o.width_m, o.depth_m, o.top_m);
}

class TableBench {
 public:
  explicit TableBench(bool verbose) : verbose_(verbose) {}

  void Run(std::uint64_t seed, const TableApproach& approach) {
    if (verbose_)
      fmt::print("  {}: {} {} {:.2f} x {:.2f} m at {:.2f}, {}\n", seed, approach.has_table ? "table" : "none",
                 approach.is_square ? "square" : "oblique", approach.table.length_m, approach.table.width_m,
                 approach.table.bottom_m + approach.table.height_m, approach.table.material);
    head::SceneTracks tracks;
    TableSeries& series = kinds[approach.is_square ? 0 : 1];
    for (std::size_t i = 0; i < approach.looks.size(); ++i) {
      const TableLook& look = approach.looks[i];
      const head::Scene scene = See(look);
      bool seen = false;
      for (const head::SceneObject& object : scene.objects) seen = Judge(object, approach, look) || seen;
      series.looks += approach.has_table;
      series.seen += seen;
      tracks.Add(scene, look.map_from_base, Time(FromSeconds(1 + 1.4 * static_cast<double>(i))));
    }
    JudgeTracks(tracks, approach, series);
  }

  std::array<TableSeries, 2> kinds;
  HangingSeries hanging;

 private:
  head::Scene See(const TableLook& look) {
    for (int c = 0; c < 3; ++c) edges_.Extract(head::Wrap(look.images[c]), seen_[c]);
    const head::StereoViews views{head::MakeView(look.calibrated[0], seen_[0]),
                                  head::MakeView(look.calibrated[1], seen_[1])};
    const head::CameraView above = head::MakeView(look.calibrated[2], seen_[2]);
    const double begin = CpuSeconds();
    auto matches = head::MatchBinocular(views[0], views[1], {});
    std::ranges::move(head::MatchTrinocular(views[0], views[1], above, {}), std::back_inserter(matches));
    auto scene = head::ReconstructScene(views, matches, {}, &above);
    hanging.seconds += CpuSeconds() - begin;
    ++hanging.looks;
    return scene;
  }

  /// Whether it is of the table.
  bool Judge(const head::SceneObject& object, const TableApproach& approach, const TableLook& look) {
    if (!head::Hangs(object)) return false;
    const bool real = approach.IsReal(object, look.map_from_base, kNear_m),
               of_table = approach.has_table && approach.IsOfTable(object, look.map_from_base, kNear_m);
    ++hanging.told;
    hanging.phantoms += !real;
    if (verbose_) PrintObject(fmt::format("gap {:.2f}", look.gap_m).c_str(), object, real, of_table);
    return of_table;
  }

  void JudgeTracks(const head::SceneTracks& tracks, const TableApproach& approach, TableSeries& series) {
    bool found = false, box = false;
    for (const head::SceneTrack& track : tracks.tracks()) {
      const head::SceneObject object = Placed(track);
      if (!tracks.IsBelieved(track) || !head::Hangs(object)) continue;
      const bool real = approach.IsReal(object, {}, kNear_m),
                 of_table = approach.has_table && approach.IsOfTable(object, {}, kNear_m);
      if (verbose_) PrintObject("believed", object, real, of_table);
      ++hanging.believed;
      hanging.believed_phantoms += !real;
      found = found || of_table;
      box = box || (of_table && object.kind == head::ObjectKind::kBox);
    }
    series.approaches += approach.has_table;
    series.found += found;
    series.boxes += box;
    if (verbose_ && approach.has_table && !found) fmt::print("    MISSED\n");
  }

  bool verbose_;
  head::EdgeOperator edges_{head::DoorEdges()};
  std::array<head::EdgeImage, 3> seen_;
};

double Share(int part, int whole) {
  return static_cast<double>(part) / std::max(1, whole);
}

void Print(const TableBench& bench, Figures& figures) {
  for (const bool square : {true, false}) {
    const TableSeries& s = bench.kinds[square ? 0 : 1];
    fmt::print("  met {}: {} of {} found, {} as boxes, in {} of {} glances\n",
               square ? "squarely" : "obliquely", s.found, s.approaches, s.boxes, s.seen, s.looks);
    figures.AtLeast(square ? "  found before 1 m, squarely" : "  found before 1 m, obliquely",
                    Share(s.found, s.approaches), 0.95, "");
  }
  const HangingSeries& h = bench.hanging;
  fmt::print(
      "  {} glances: {} hanging things, {} of them phantoms; {} believed, {} phantoms; {:.1f} ms each\n",
      h.looks, h.told, h.phantoms, h.believed, h.believed_phantoms, 1e3 * h.seconds / h.looks);
  figures.AtMost("  phantoms per glance", Share(h.phantoms, h.looks), 0.02, "");
}

}  // namespace

void BenchTables(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 40 : 400;
  fmt::print("tables that a base comes to in made-up rooms, {} approaches of 3 glances\n", n);
  TablePhotographer photographer;
  const CalibratedHead head = CalibrateSpecimenWholly(1);
  TableBench bench(options.verbose);
  for (int i = 0; i < n; ++i) bench.Run(options.seed + i, photographer.Take(options.seed + i, head));
  Print(bench, figures);
}

}  // namespace priamos::bench
