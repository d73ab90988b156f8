#pragma once

#include <vector>

#include "common/time.hpp"
#include "head/core/scene/scene_objects.hpp"
#include "head/core/scene/scene_track.hpp"
#include "head/core/tracks/turn_taking.hpp"

namespace priamos::head {

/// What is the same object, and when one is believed.
struct SceneTrackOptions {
  double same_m = 0.25;       ///< fronts whose middles are nearer may be one ...
  double same_yaw_rad = 0.5;  ///< ... if they are turned against each other by less
  double same_edge_m = 0.1;   ///< edges that are nearer are one, or part of a front
  PlaceOptions place;
  double max_sigma_m = 0.15;  ///< an object that claims more is of no use
  int min_looks = 2;          ///< that showed it before it is told ...
  double min_driven_m = 0.1;  ///< ... from places that are so far apart: the same pair errs in the same way
  int gone_after = 2;         ///< looks that saw through it before it has gone
  double behind_m = 0.1;      ///< what is seen through it is farther behind it than this
  double gone_for_s = 60;     ///< so long is told that it has gone
  double told_for_s = 600;    ///< what was not seen for longest is not told again
  int most = 64;              ///< of more, that goes which was not seen for longest
};

/// What stands on the floor, map frame.
class SceneTracks {
 public:
  explicit SceneTracks(const SceneTrackOptions& options = {}) : options_(options) {}

  /// Takes what one look showed from `map_from_base`.
  void Add(const Scene& scene, const Pose2& map_from_base, Time exposure);
  /// Forgets them all, because the frame of the map is another one now.
  void Forget() { tracks_.clear(); }
  /// Moves them all, because the robot's pose was corrected.
  void Move(const Pose2& new_from_old);
  /// Whether enough looks showed it.
  bool IsBelieved(const SceneTrack& track) const;
  /// Whether it stood there, and looks saw through where it did.
  bool HasGone(const SceneTrack& track) const { return track.through >= options_.gone_after; }
  /// Those that may be told now, for TurnTaking.
  std::vector<Tellable> Tellables(Time now) const;
  /// Of them those that hang: no sonar hears them.
  std::vector<Tellable> Urgent(Time now) const;
  /// All of them, in the order in which they were found.
  const std::vector<SceneTrack>& tracks() const { return tracks_; }

 private:
  SceneTrack* Find(const SceneTrack& seen);
  void Join(const SceneTrack& seen, SceneTrack& track) const;
  bool IsPartOfFront(const SceneTrack& edge) const;
  bool IsSeenThroughNow(const SceneTrack& track, const Scene& scene, const Pose2& map_from_base) const;
  void LookThrough(const Scene& scene, const Pose2& map_from_base, Time exposure);

  SceneTrackOptions options_;
  std::vector<SceneTrack> tracks_;
  int last_id_ = -1;
};

}  // namespace priamos::head
