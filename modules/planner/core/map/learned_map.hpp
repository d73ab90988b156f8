#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "common/archive.hpp"
#include "common/learned/learned_walls.hpp"
#include "common/learned/object_book.hpp"
#include "planner/core/map/point_book.hpp"
#include "planner/core/map/seen_feature.hpp"

namespace priamos::planner {

/// Which walls are the same, and how many are kept.
struct LearnedMapConfig {
  double gate = 3.0;          ///< Mahalanobis distance of two walls up to which they may be one
  double across_m = 0.25;     ///< they are never farther apart than this ...
  double turned_deg = 12;     ///< ... nor turned against each other more
  double gap_m = 0.3;         ///< along them, between the end of one and the beginning of the other
  double most_length_m = 12;  ///< of a wall that is put together
  int most = 2000;            ///< walls; of more, that goes which was not heard for longest

  void Describe(Archive& a);
};

/// The walls and points that robots found, in the map frame. What is told again under its number replaces
/// what was told before. Walls that lie on each other, or follow each other, are one: their lines are joined
/// by covariance intersection (Julier and Uhlmann), which is consistent whatever part of their errors they
/// share, for instance that of the pose from which both were seen.
class LearnedMap {
 public:
  explicit LearnedMap(const LearnedMapConfig& config, LearnedWalls known = {});

  /// Takes what a robot tells. Returns whether the map is another one now.
  bool Take(const SeenFeature& seen);
  /// Takes what a robot tells of a door, see EnterDoor(); likewise.
  bool Take(const LearnedDoor& told);
  /// Takes what a robot tells of a thing, see EnterObject(); likewise.
  bool Take(const LearnedObject& told) { return EnterObject(told, walls_); }
  /// Holds these walls and points from now on, whatever robots told before. Doors stay, and things unless it
  /// brings some.
  void Replace(LearnedWalls walls);
  /// Forgets everything.
  void Reset();
  /// What it holds; the revision counts its changes.
  const LearnedWalls& walls() const { return walls_; }

 private:
  void NoteOlder();
  bool Forget(const FeatureName& name);
  void TakeWall(const FeatureName& name, const LearnedWall& told);
  void Leave(const FeatureName& name);
  LearnedWall* Find(int id);
  LearnedWall& Begin(const FeatureName& name, const LearnedWall& told);
  void Consolidate(int id);
  void Remove(int id);
  void MakeRoom();
  bool AreOne(const LearnedWall& a, const LearnedWall& b) const;

  LearnedMapConfig config_;
  LearnedWalls walls_;
  std::map<FeatureName, int> ids_;              ///< of the wall that a name is part of
  std::map<int, std::set<FeatureName>> names_;  ///< the other way round
  std::set<int> older_;                         ///< walls that hold more than what these names tell
  PointBook points_;
  int last_id_ = 0;
};

}  // namespace priamos::planner
