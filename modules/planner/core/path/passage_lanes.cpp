#include "planner/core/path/passage_lanes.hpp"

#include <array>

namespace priamos::planner {
namespace {

/// Between the body and the narrowest place at either end: who turns into a lane needs room, and less only
/// where there is none.
constexpr std::array kOff_m{0.4, 0.25, 0.1};

/// The end of a lane in front of its middle, at the middle's heading; no farther than it has to be when even
/// the way there is not free.
Pose2 EndOf(const Pose2& middle, double least_m, const SweptFootprint& space, double margin_m) {
  for (const double off_m : kOff_m)
    if (const Pose2 end = middle * Pose2{least_m + off_m, 0, 0}; space.IsFree(middle, end, margin_m))
      return end;
  return middle * Pose2{least_m + kOff_m.back(), 0, 0};
}

}  // namespace

std::vector<PassageLane> LanesThrough(const std::vector<NarrowPassage>& passages, const SweptFootprint& space,
                                      double margin_m) {
  constexpr Pose2 kAround{0, 0, kPi};
  std::vector<PassageLane> lanes;
  for (const NarrowPassage& passage : passages) {
    const Pose2& middle = passage.map_from_passage;
    const double least_m = passage.half_long_m + space.footprint().length_m / 2;
    const Pose2 behind = EndOf(middle, least_m, space, margin_m),
                before = EndOf(middle * kAround, least_m, space, margin_m) * kAround;
    if (!space.IsFree(before, behind, margin_m)) continue;
    lanes.push_back({before, behind, passage});
    lanes.push_back({behind * kAround, before * kAround, passage});
  }
  return lanes;
}

}  // namespace priamos::planner
