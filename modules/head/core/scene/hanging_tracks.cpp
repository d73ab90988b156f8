#include "head/core/scene/hanging_tracks.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr double kThin_m = 0.12, kSameTop_m = 0.08, kBesideTop_m = 0.1;
constexpr double kLarger_m = 0.06, kSameFront_rad = 0.3, kNear_m = 0.2;

Eigen::Vector2d MiddleOf(const SceneTrack& track) {
  return track.place.map_from_thing * Eigen::Vector2d(track.object.depth_m / 2, 0);
}

bool Covers(const SceneTrack& top, const Eigen::Vector2d& at) {
  const Eigen::Vector2d in = top.place.map_from_thing.Inverse() * at;
  return in.x() > -kBesideTop_m && in.x() < top.object.depth_m + kBesideTop_m &&
         std::abs(in.y()) < top.object.width_m / 2 + kBesideTop_m;
}

double SizeOf(const SceneObject& object) {
  return object.width_m + object.depth_m;
}

}  // namespace

bool Hangs(const SceneObject& object) {
  return object.kind != ObjectKind::kEdge && object.bottom_m > 0 && object.top_m - object.bottom_m < kThin_m;
}

bool AreOneTop(const SceneTrack& a, const SceneTrack& b) {
  return std::abs(a.object.top_m - b.object.top_m) < kSameTop_m &&
         (Covers(a, MiddleOf(b)) || Covers(b, MiddleOf(a)));
}

void JoinTop(const SceneTrack& seen, const PlaceOptions& options, SceneTrack& track) {
  const double larger_m = SizeOf(seen.object) - SizeOf(track.object);
  const Pose2 between = track.place.map_from_thing.Inverse() * seen.place.map_from_thing;
  const bool same_front = std::abs(WrapAngle(between.yaw)) < kSameFront_rad &&
                          between.translation().norm() < kNear_m && seen.object.kind == track.object.kind;
  if (larger_m > kLarger_m) {
    track.place = seen.place;
    track.object = seen.object;
  } else if (larger_m > -kLarger_m && same_front) {
    const double share = Fuse(seen.place, options, track.place);
    track.object.width_m += share * (seen.object.width_m - track.object.width_m);
    track.object.depth_m += share * (seen.object.depth_m - track.object.depth_m);
    track.object.top_m += share * (seen.object.top_m - track.object.top_m);
    track.object.bottom_m += share * (seen.object.bottom_m - track.object.bottom_m);
  }
  track.place.map_from_base = seen.place.map_from_base;
}

}  // namespace priamos::head
