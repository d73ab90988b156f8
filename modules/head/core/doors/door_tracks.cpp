#include "head/core/doors/door_tracks.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/tracks/track_list.hpp"

namespace priamos::head {
namespace {

/// A sighting as a track of its own.
DoorTrack AsTrack(const DoorSighting& sighting, const Pose2& map_from_base, Time exposure,
                  const PlaceOptions& options) {
  DoorTrack track;
  track.seen = exposure;
  track.place = PlaceOf(sighting.door.base_from_door, sighting.door.covariance, map_from_base, options);
  track.width_m = sighting.door.width_m;
  track.state = sighting.state;
  track.log_odds = sighting.door.log_odds;
  track.looks = 1;
  return track;
}

/// Limits what was seen of the state before, so that a few looks can tell that a leaf has moved.
void Limit(DoorStateEvidence& state, double most) {
  const double best = *std::max_element(state.log_likelihood.begin(), state.log_likelihood.end());
  for (double& value : state.log_likelihood) value = std::max(value - best, -most);
}

}  // namespace

DoorTrack* DoorTracks::Find(const Pose2& map_from_door) {
  DoorTrack* nearest = nullptr;
  double least_m = options_.same_m;
  for (DoorTrack& track : tracks_) {
    const double away_m = (track.place.map_from_thing.translation() - map_from_door.translation()).norm();
    if (away_m > least_m) continue;
    least_m = away_m;
    nearest = &track;
  }
  return nearest;
}

void DoorTracks::Join(DoorTrack& track, const DoorTrack& seen) const {
  const double share = Fuse(seen.place, options_.place, track.place);
  track.width_m += share * (seen.width_m - track.width_m);
  Limit(track.state, options_.max_state);
  track.state += seen.state;
  track.log_odds = std::max(track.log_odds, seen.log_odds);
  track.seen = seen.seen;
  ++track.looks;
}

void DoorTracks::Move(const Pose2& new_from_old) {
  for (DoorTrack& track : tracks_) head::Move(new_from_old, track.place);
}

std::vector<Tellable> DoorTracks::Tellables(Time now) const {
  std::vector<Tellable> doors;
  for (const DoorTrack& track : tracks_)
    if (IsBelieved(track) && Seconds(now - track.seen) <= options_.told_for_s)
      doors.push_back({track.id, track.place.map_from_thing.translation(), static_cast<int>(StateOf(track))});
  return doors;
}

void DoorTracks::Add(std::span<const DoorSighting> sightings, const Pose2& map_from_base, Time exposure) {
  for (const DoorSighting& sighting : sightings) {
    const DoorTrack seen = AsTrack(sighting, map_from_base, exposure, options_.place);
    if (SigmaOf(seen.place.covariance) > options_.max_sigma_m) continue;
    if (DoorTrack* track = Find(seen.place.map_from_thing))
      Join(*track, seen);
    else
      BeginTrack(seen, options_.most, last_id_, tracks_);
  }
}

}  // namespace priamos::head
