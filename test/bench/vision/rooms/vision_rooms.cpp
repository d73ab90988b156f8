#include <fmt/format.h>

#include <Eigen/Dense>
#include <map>

#include "test/bench/vision/fix_series.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/rooms/made_up_doors.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

using head::LandmarkFix;

void Count(const RoomLook& room, const LandmarkFix& fix, std::uint64_t seed, const VisionOptions& options,
           FixSeries& series) {
  const int good = series.good;
  series.Judge(fix, room.look, seed);
  const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, room.look.truth);
  if (series.good > good) series.nees.push_back(error.dot(fix.covariance.inverse() * error) / 3);
  if (!options.verbose) return;
  fmt::print("  {} walls, {:.2f} m;", room.wall, room.look.truth.x);
  Print(seed, fix, error);
}

void Tell(const std::string& what, const FixSeries& s) {
  fmt::print("  {}: {} of {} right, {} wrong", what, s.good, s.looks, s.wrong);
  if (!s.nees.empty()) fmt::print(", squared error over covariance {:.2f}", s.MeanNees());
  for (const auto& [why, n] : s.refusals) fmt::print("; {}: {}", why, n);
  fmt::print("\n");
}

}  // namespace

void BenchRooms(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 40 : 400;
  fmt::print("doors of made-up rooms and floors, 2.0 to 3.4 m, plan by a tape: {} looks of each kind\n", n);
  RoomPhotographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimen(1);
  int wrong = 0;
  for (const auto trouble : {RoomTrouble::kNone, RoomTrouble::kDoorAbsent, RoomTrouble::kAnotherDoor}) {
    std::map<std::string, FixSeries> by_wall;
    for (int i = 0; i < n; ++i) {
      const std::uint64_t seed = options.seed + i;
      const RoomLook room = photographer.Take(i % 3 == 0 ? "floor" : "room", seed, trouble, head);
      const LandmarkFix fix = fixer.Find(room.look, Told(room.look), room.look.model, room.look.calibrated);
      Count(room, fix, seed, options, by_wall[room.wall + " walls"]);
    }
    fmt::print(" {}\n", Describe(trouble));
    double good = 0;
    for (const auto& [wall, series] : by_wall) {
      Tell(wall, series);
      good += series.good;
      wrong += series.wrong;
    }
    if (trouble == RoomTrouble::kNone) figures.AtLeast("  right ones", good / n, 0.98, "");
  }
  figures.AtMost("  silent wrong fixes", wrong, 0, "");
}

}  // namespace priamos::bench
