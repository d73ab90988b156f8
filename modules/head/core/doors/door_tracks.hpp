#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "head/core/doors/door_detection.hpp"
#include "head/core/doors/door_state.hpp"
#include "head/core/tracks/tracked_place.hpp"
#include "head/core/tracks/turn_taking.hpp"

namespace priamos::head {

/// A door in one stereo pair.
struct DoorSighting {
  DetectedDoor door;  ///< base frame
  DoorStateEvidence state;
};

/// A door as all looks that showed it put it together.
struct DoorTrack {
  int id = 0;
  Time seen{};         ///< exposure of the newest of them
  TrackedPlace place;  ///< middle between its uprights; x away from where it was seen
  double width_m = 0;
  DoorStateEvidence state;
  double log_odds = 0;  ///< of a door, of the look that told most
  int looks = 0;
};

/// What is the same door, and when one is believed.
struct DoorTrackOptions {
  double same_m = 0.65;  ///< sightings nearer to each other are one door
  PlaceOptions place;
  double max_sigma_m = 0.15;  ///< a sighting that claims more is of no use
  int min_looks = 2;          ///< that showed a door before it is told
  double max_state = 6;       ///< what all looks together may say of the state, so that a leaf may move
  double state_lead = 2;      ///< log likelihood wanted over the next best state
  double told_for_s = 600;    ///< a door that was not seen for longest is not told again
  int most = 64;              ///< doors; of more, that goes which was not seen for longest
};

/// The doors that looks in passing have shown, map frame.
class DoorTracks {
 public:
  explicit DoorTracks(const DoorTrackOptions& options = {}) : options_(options) {}

  /// Takes what one look showed from `map_from_base`.
  void Add(std::span<const DoorSighting> sightings, const Pose2& map_from_base, Time exposure);
  /// Forgets them all, because the frame of the map is another one now.
  void Forget() { tracks_.clear(); }
  /// Moves them all, because the robot's pose was corrected.
  void Move(const Pose2& new_from_old);
  /// Whether enough looks showed it.
  bool IsBelieved(const DoorTrack& track) const { return track.looks >= options_.min_looks; }
  DoorState StateOf(const DoorTrack& track) const { return track.state.State(options_.state_lead); }
  /// Those that may be told now, for TurnTaking.
  std::vector<Tellable> Tellables(Time now) const;
  /// All of them, in the order in which they were found.
  const std::vector<DoorTrack>& tracks() const { return tracks_; }

 private:
  DoorTrack* Find(const Pose2& map_from_door);
  void Join(DoorTrack& track, const DoorTrack& seen) const;

  DoorTrackOptions options_;
  std::vector<DoorTrack> tracks_;
  int last_id_ = -1;
};

}  // namespace priamos::head
