#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "head/core/doors/door_detection.hpp"
#include "head/core/doors/door_state.hpp"

namespace priamos::head {

/// A door in one stereo pair.
struct DoorSighting {
  DetectedDoor door;  ///< base frame
  DoorStateEvidence state;
};

/// A door as all looks that showed it put it together.
struct DoorTrack {
  int id = 0;
  Time seen{};                 ///< exposure of the newest of them
  Pose2 map_from_door;         ///< middle between its uprights; x away from where it was seen
  Eigen::Matrix2d covariance;  ///< of that middle, map frame, without the error of the robot's pose [m^2]
  double width_m = 0;
  DoorStateEvidence state;
  double log_odds = 0;  ///< of a door, of the look that told most
  int looks = 0;
  Pose2 map_from_base;     ///< from where it was seen last
  Eigen::Matrix2d single;  ///< covariance of the look that told its place best [m^2]
};

/// What is the same door, and when one is believed.
struct DoorTrackOptions {
  double same_m = 0.65;       ///< sightings nearer to each other are one door
  double drift = 0.01;        ///< error of the way driven between two looks, share of its length
  double drift_m = 0.005;     ///< and of each look, beyond what the pictures tell
  double gate = 4;            ///< sigmas; beyond that the door is put where it was seen last
  double max_sigma_m = 0.15;  ///< a sighting that claims more is of no use
  int min_looks = 2;          ///< that showed a door before it is told
  double max_state = 6;       ///< what all looks together may say of the state, so that a leaf may move
  double state_lead = 2;      ///< log likelihood wanted over the next best state
  int most = 64;              ///< doors; of more, that goes which was not seen for longest
};

/// The doors that looks in passing have shown, map frame. Looks are taken for independent but for the drift
/// of the pose between them; an error that all share, as that of the calibration, is in the covariance of
/// each and stays: fused ones are never better than half of the best single one.
class DoorTracks {
 public:
  explicit DoorTracks(const DoorTrackOptions& options = {}) : options_(options) {}

  /// Takes what one look showed from `map_from_base`.
  void Add(std::span<const DoorSighting> sightings, const Pose2& map_from_base, Time exposure);
  /// Forgets them all, because the frame of the map is another one now.
  void Forget() { tracks_.clear(); }
  /// Whether enough looks showed it.
  bool IsBelieved(const DoorTrack& track) const { return track.looks >= options_.min_looks; }
  DoorState StateOf(const DoorTrack& track) const { return track.state.State(options_.state_lead); }
  /// All of them, in the order in which they were found.
  const std::vector<DoorTrack>& tracks() const { return tracks_; }

 private:
  DoorTrack* Find(const Pose2& map_from_door);
  void Begin(DoorTrack seen);
  void Join(DoorTrack& track, const DoorTrack& seen) const;
  void Place(DoorTrack& track, const DoorTrack& seen) const;

  DoorTrackOptions options_;
  std::vector<DoorTrack> tracks_;
  int last_id_ = -1;
};

}  // namespace priamos::head
