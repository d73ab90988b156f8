#pragma once

#include <map>
#include <vector>

#include "common/learned/learned_object.hpp"
#include "planner/core/graph/floor_graph.hpp"

namespace priamos::planner {

/// Things that the head told while the map was being made. It tells them in the robot's own frame, which
/// drifts: each is tied to the place of the map where it lay when it was told, and moves with that.
class AnchoredObjects {
 public:
  void Reset() { objects_.clear(); }
  /// Takes all that are known by now, robot's own frame; of those that were taken before and not told since
  /// the place stays. Returns whether anything is another.
  bool Take(const std::vector<LearnedObject>& told, const FloorGraph& graph);
  /// Where they lie by now, map frame.
  std::vector<LearnedObject> At(const FloorGraph& graph) const;

 private:
  struct Anchored {
    LearnedObject told;
    GraphAnchor front;
  };
  std::map<int, Anchored> objects_;  ///< by their numbers
};

}  // namespace priamos::planner
