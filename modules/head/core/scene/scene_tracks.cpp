#include "head/core/scene/scene_tracks.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/scene/face_sights.hpp"
#include "head/core/scene/hanging_tracks.hpp"
#include "head/core/tracks/track_list.hpp"

namespace priamos::head {
namespace {

SceneTrack AsTrack(const SceneObject& object, const Pose2& map_from_base, Time exposure,
                   const PlaceOptions& options) {
  SceneTrack track;
  track.seen = exposure;
  track.place = PlaceOf(object.base_from_front, object.covariance, map_from_base, options);
  track.object = object;
  track.looks = 1;
  track.map_from_first_base = map_from_base;
  return track;
}

bool IsEdge(const SceneTrack& track) {
  return track.object.kind == ObjectKind::kEdge;
}

double Apart(const SceneTrack& a, const SceneTrack& b) {
  return (a.place.map_from_thing.translation() - b.place.map_from_thing.translation()).norm();
}

/// What is averaged, and what is known as soon as one look shows it.
void JoinMeasures(const SceneObject& seen, double share, SceneObject& object) {
  object.width_m += share * (seen.width_m - object.width_m);
  object.bottom_m = std::min(object.bottom_m, seen.bottom_m);
  object.top_m += share * (seen.top_m - object.top_m);
  object.sigma_yaw_rad = std::min(object.sigma_yaw_rad, seen.sigma_yaw_rad);
  if (seen.kind != ObjectKind::kBox) return;
  object.depth_m = object.kind == ObjectKind::kBox ? object.depth_m + share * (seen.depth_m - object.depth_m)
                                                   : seen.depth_m;
  object.kind = ObjectKind::kBox;
}

/// Its front, as a robot sees it that is elsewhere now.
FacePlane FrontOf(const SceneTrack& track, const Pose2& map_from_base) {
  const Pose2 front = map_from_base.Inverse() * track.place.map_from_thing;
  const double half = track.object.width_m / 2;
  return {front * Eigen::Vector2d(0, half), front * Eigen::Vector2d(0, -half), track.object.bottom_m,
          track.object.top_m};
}

}  // namespace

void SceneTracks::Move(const Pose2& new_from_old) {
  for (SceneTrack& track : tracks_) {
    head::Move(new_from_old, track.place);
    track.map_from_first_base = new_from_old * track.map_from_first_base;
  }
}

bool SceneTracks::IsBelieved(const SceneTrack& track) const {
  const double driven_m =
      (track.place.map_from_base.translation() - track.map_from_first_base.translation()).norm();
  return track.looks >= options_.min_looks && driven_m >= options_.min_driven_m;
}

std::vector<Tellable> SceneTracks::Tellables(Time now) const {
  constexpr int kGone = -1;
  std::vector<Tellable> objects;
  for (const SceneTrack& track : tracks_) {
    if (!IsBelieved(track) || Seconds(now - track.seen) > options_.told_for_s) continue;
    objects.push_back({track.id, track.place.map_from_thing.translation(),
                       HasGone(track) ? kGone : static_cast<int>(track.object.kind),
                       IsEdge(track)         ? 0
                       : Hangs(track.object) ? 2
                                             : 1});
  }
  return objects;
}

std::vector<Tellable> SceneTracks::Urgent(Time now) const {
  std::vector<Tellable> all = Tellables(now);
  std::erase_if(all, [&](const Tellable& thing) {
    return !std::any_of(tracks_.begin(), tracks_.end(),
                        [&](const SceneTrack& track) { return track.id == thing.id && Hangs(track.object); });
  });
  return all;
}

SceneTrack* SceneTracks::Find(const SceneTrack& seen) {
  SceneTrack* nearest = nullptr;
  double least_m = IsEdge(seen) ? options_.same_edge_m : options_.same_m;
  for (SceneTrack& track : tracks_) {
    if (HasGone(track) || IsEdge(track) != IsEdge(seen) || Hangs(track.object) != Hangs(seen.object))
      continue;
    if (Hangs(seen.object)) {
      if (AreOneTop(track, seen)) return &track;
      continue;
    }
    if (Apart(track, seen) > least_m) continue;
    const double turn = WrapAngle(track.place.map_from_thing.yaw - seen.place.map_from_thing.yaw);
    if (!IsEdge(seen) && std::abs(turn) > options_.same_yaw_rad) continue;
    least_m = Apart(track, seen);
    nearest = &track;
  }
  return nearest;
}

void SceneTracks::Join(const SceneTrack& seen, SceneTrack& track) const {
  if (Hangs(seen.object)) {
    JoinTop(seen, options_.place, track);
  } else {
    const double share = Fuse(seen.place, options_.place, track.place);
    JoinMeasures(seen.object, share, track.object);
  }
  track.seen = seen.seen;
  track.through = 0;
  ++track.looks;
}

/// An arris that once stood alone belongs to a front that a later look showed.
bool SceneTracks::IsPartOfFront(const SceneTrack& edge) const {
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const SceneTrack& front) {
    if (IsEdge(front) || HasGone(front)) return false;
    const Eigen::Vector2d half(0, front.object.width_m / 2);
    return DistanceToSegment(front.place.map_from_thing * Eigen::Vector2d(-half),
                             front.place.map_from_thing * half,
                             edge.place.map_from_thing.translation()) < options_.same_edge_m;
  });
}

bool SceneTracks::IsSeenThroughNow(const SceneTrack& track, const Scene& scene,
                                   const Pose2& map_from_base) const {
  const FacePlane front = FrontOf(track, map_from_base);
  if (!Hangs(track.object)) return IsSeenThrough(front, scene.left, scene.edges, options_.behind_m);
  return IsMissing({front.from.x(), front.from.y(), front.top_m}, {front.to.x(), front.to.y(), front.top_m},
                   scene.left, scene.lines);
}

/// Counts for each front that was not seen now whether something behind it was.
void SceneTracks::LookThrough(const Scene& scene, const Pose2& map_from_base, Time exposure) {
  for (SceneTrack& track : tracks_) {
    if (IsEdge(track) || HasGone(track) || track.seen == exposure) continue;
    if (!IsSeenThroughNow(track, scene, map_from_base)) continue;
    if (++track.through == options_.gone_after) track.seen = exposure;
  }
  std::erase_if(tracks_, [&](const SceneTrack& track) {
    return HasGone(track) && (!IsBelieved(track) || Seconds(exposure - track.seen) > options_.gone_for_s);
  });
}

void SceneTracks::Add(const Scene& scene, const Pose2& map_from_base, Time exposure) {
  for (const SceneObject& object : scene.objects) {
    SceneTrack seen = AsTrack(object, map_from_base, exposure, options_.place);
    if (SigmaOf(seen.place.covariance) > options_.max_sigma_m) continue;
    if (SceneTrack* track = Find(seen))
      Join(seen, *track);
    else
      BeginTrack(std::move(seen), options_.most, last_id_, tracks_);
  }
  std::erase_if(tracks_, [&](const SceneTrack& track) { return IsEdge(track) && IsPartOfFront(track); });
  LookThrough(scene, map_from_base, exposure);
}

}  // namespace priamos::head
