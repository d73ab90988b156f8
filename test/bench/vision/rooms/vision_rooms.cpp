#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
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

/// What a number of cameras found, by the walls' material.
struct CameraSeries {
  Fixer fixer;
  std::map<std::string, FixSeries> by_wall;
  int wrong = 0;  ///< of all troubles

  void Look(const RoomLook& room, std::uint64_t seed, const VisionOptions& options) {
    const LandmarkFix fix = fixer.Find(room.look, Told(room.look), room.look.model, room.look.calibrated);
    Count(room, fix, seed, options, by_wall[room.wall + " walls"]);
  }
  /// Prints what was found, and forgets it. Returns the number of right ones.
  int TellAll() {
    fmt::print("  {} cameras\n", fixer.with_third ? "three" : "two");
    int good = 0;
    for (const auto& [wall, series] : by_wall) {
      Tell(wall, series);
      good += series.good;
      wrong += series.wrong;
    }
    by_wall.clear();
    return good;
  }
};

}  // namespace

void BenchRooms(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 40 : 400;
  fmt::print("doors of made-up rooms and floors, 2.0 to 3.4 m, plan by a tape: {} looks of each kind\n", n);
  RoomPhotographer photographer;
  const CalibratedHead head = CalibrateSpecimen(1);
  std::array<CameraSeries, 2> cameras;
  cameras[1].fixer.with_third = true;
  for (const auto trouble : {RoomTrouble::kNone, RoomTrouble::kDoorAbsent, RoomTrouble::kAnotherDoor}) {
    for (int i = 0; i < n; ++i) {
      const std::uint64_t seed = options.seed + i;
      const RoomLook room = photographer.Take(i % 3 == 0 ? "floor" : "room", seed, trouble, head);
      for (CameraSeries& series : cameras) series.Look(room, seed, options);
    }
    fmt::print(" {}\n", Describe(trouble));
    for (CameraSeries& series : cameras) {
      const int good = series.TellAll();
      if (trouble == RoomTrouble::kNone)
        figures.AtLeast("  right ones", static_cast<double>(good) / n, 0.98, "");
    }
  }
  for (const CameraSeries& series : cameras)
    figures.AtMost(fmt::format("  silent wrong fixes, {} cameras", series.fixer.with_third ? "three" : "two"),
                   series.wrong, 0, "");
}

}  // namespace priamos::bench
