#include "planner/core/path/passage_lanes.hpp"

#include <numbers>

namespace priamos::planner {
namespace {

/// Between the body and the narrowest place at either end.
constexpr double kOff_m = 0.1;

}  // namespace

std::vector<PassageLane> LanesThrough(const std::vector<NarrowPassage>& passages, const SweptFootprint& space,
                                      double margin_m) {
  std::vector<PassageLane> lanes;
  const double body_m = space.footprint().length_m / 2 + kOff_m;
  for (const NarrowPassage& passage : passages) {
    const Pose2 ahead = passage.map_from_passage, back = ahead * Pose2{0, 0, std::numbers::pi};
    const double end_m = passage.half_long_m + body_m;
    if (!space.IsFree(ahead * Pose2{-end_m, 0, 0}, ahead * Pose2{end_m, 0, 0}, margin_m)) continue;
    for (const Pose2& middle : {ahead, back})
      lanes.push_back({middle * Pose2{-end_m, 0, 0}, middle * Pose2{end_m, 0, 0}});
  }
  return lanes;
}

}  // namespace priamos::planner
