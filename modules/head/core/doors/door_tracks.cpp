#include "head/core/doors/door_tracks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr int kIds = 256;

/// A sighting as a track of its own.
DoorTrack AsTrack(const DoorSighting& sighting, const Pose2& map_from_base, Time exposure, double drift_m) {
  const Eigen::Matrix2d turn = map_from_base.rotation();
  DoorTrack track;
  track.seen = exposure;
  track.map_from_door = map_from_base * sighting.door.base_from_door;
  track.covariance =
      turn * sighting.door.covariance * turn.transpose() + drift_m * drift_m * Eigen::Matrix2d::Identity();
  track.width_m = sighting.door.width_m;
  track.state = sighting.state;
  track.log_odds = sighting.door.log_odds;
  track.looks = 1;
  track.map_from_base = map_from_base;
  track.single = track.covariance;
  return track;
}

double SigmaOf(const Eigen::Matrix2d& covariance) {
  return std::sqrt(covariance.trace());
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
    const double away_m = (track.map_from_door.translation() - map_from_door.translation()).norm();
    if (away_m > least_m) continue;
    least_m = away_m;
    nearest = &track;
  }
  return nearest;
}

void DoorTracks::Begin(DoorTrack seen) {
  if (tracks_.size() >= static_cast<std::size_t>(options_.most))
    tracks_.erase(std::min_element(tracks_.begin(), tracks_.end(),
                                   [](const auto& a, const auto& b) { return a.seen < b.seen; }));
  last_id_ = (last_id_ + 1) % kIds;
  seen.id = last_id_;
  tracks_.push_back(seen);
}

/// Weighs both places by their covariances; what contradicts the one before takes its place.
void DoorTracks::Place(DoorTrack& track, const DoorTrack& seen) const {
  const double driven_m = (seen.map_from_base.translation() - track.map_from_base.translation()).norm();
  const double drift_m = options_.drift * driven_m;
  const Eigen::Matrix2d before = track.covariance + drift_m * drift_m * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d off = seen.map_from_door.translation() - track.map_from_door.translation();
  const Eigen::Matrix2d both = before + seen.covariance;
  if (off.dot(both.inverse() * off) > options_.gate * options_.gate) {
    track.map_from_door = seen.map_from_door;
    track.covariance = track.single = seen.covariance;
    track.width_m = seen.width_m;
    return;
  }
  const Eigen::Matrix2d gain = before * both.inverse();
  const Eigen::Vector2d at = track.map_from_door.translation() + gain * off;
  track.map_from_door.x = at.x();
  track.map_from_door.y = at.y();
  const double share = SigmaOf(before) / (SigmaOf(before) + SigmaOf(seen.covariance));
  const double turn = WrapAngle(seen.map_from_door.yaw - track.map_from_door.yaw);
  if (std::abs(turn) < kPi / 2) track.map_from_door.yaw = WrapAngle(track.map_from_door.yaw + share * turn);
  track.width_m += share * (seen.width_m - track.width_m);
  if (SigmaOf(seen.covariance) < SigmaOf(track.single)) track.single = seen.covariance;
  track.covariance = before - gain * before;
  const double least = track.single.trace() / 4 / std::max(1e-12, track.covariance.trace());
  if (least > 1) track.covariance *= least;
}

void DoorTracks::Join(DoorTrack& track, const DoorTrack& seen) const {
  Place(track, seen);
  Limit(track.state, options_.max_state);
  track.state += seen.state;
  track.log_odds = std::max(track.log_odds, seen.log_odds);
  track.seen = seen.seen;
  track.map_from_base = seen.map_from_base;
  ++track.looks;
}

void DoorTracks::Add(std::span<const DoorSighting> sightings, const Pose2& map_from_base, Time exposure) {
  for (const DoorSighting& sighting : sightings) {
    const DoorTrack seen = AsTrack(sighting, map_from_base, exposure, options_.drift_m);
    if (SigmaOf(seen.covariance) > options_.max_sigma_m) continue;
    if (DoorTrack* track = Find(seen.map_from_door))
      Join(*track, seen);
    else
      Begin(seen);
  }
}

}  // namespace priamos::head
